#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "floc/network/rattlers.h"
#include "floc/structure/coordination.h"
#include "floc/structure/force_distribution.h"
#include "floc/structure/force_moments.h"
#include "floc/structure/gap_coordination.h"
#include "floc/structure/pair_correlation.h"
#include "floc/structure/particle_stress.h"
#include "floc/structure/pores.h"
#include "floc/structure/pressure_phases.h"
#include "floc/structure/pushed_rattlers.h"
#include "floc/structure/scattering.h"
#include "support/contact_laws.h"
#include "support/network_packings.h"

namespace floc::test {
namespace {

/// All measured quantities of a packing. `exact` contains the quantities that do not depend on the mesh, and `on_mesh`
/// those that do.
struct Measured {
  std::vector<double> exact, on_mesh;
};

void append(std::vector<double>& list, std::vector<double> more, bool sorted = false) {
  if (sorted) std::sort(more.begin(), more.end());
  list.insert(list.end(), more.begin(), more.end());
}

/// Returns disks at random positions, with some contacts, and with gaps that leave room for rattlers. The radii are
/// reduced until disks hardly overlap.
Packing<2> loose_packing() {
  Packing<2> packing = random_packing<2>(80, 3, elastic_law(1.0, 0.5, 0.1), 0.85);
  packing.law += test::changed("friction.coefficient", 0.5);
  for (int pass = 0; pass < 200; ++pass) {
    find_contacts(packing);
    for (const Contact<2>& c : packing.contacts) {
      packing.grains.position[c.i] += 0.4 * c.gap * c.normal;
      packing.grains.position[c.j] -= 0.4 * c.gap * c.normal;
    }
  }
  for (double& R : packing.grains.radius) R *= 1.002;
  find_contacts(packing);
  return packing;
}

Measured measure(const Packing<2>& packing) {
  Measured m;
  const Coordination c = coordination(packing, 1e-9);
  append(m.exact, {c.z, c.z_star, c.x22, c.rattler_fraction, c.z_plus});
  const ForceMoments f = force_moments(packing);
  append(m.exact, {f.mean_normal, f.Z[0], f.Z[2], f.M1, f.M2});
  append(m.exact, contact_forces(packing, ForceKind::normal), true);
  const std::vector<double> p = particle_pressure(packing);
  append(m.exact, p, true);
  // Half of the grains are treated as grains under tension. They are chosen by size, because the choice must not depend
  // on the numbers of the grains.
  std::vector<double> signed_pressure;
  for (const double R : packing.grains.radius) signed_pressure.push_back(R - 0.5);
  const PressurePhases phases = pressure_phases(contact_network(packing), signed_pressure);
  append(m.exact, {phases.positive.share, double(phases.positive.largest_cluster),
                   double(phases.negative.n_clusters), double(phases.positive.n_directions)});
  append(m.exact, pair_correlation(packing, 6.0, 30).g);
  const std::vector<double> gaps = {0.001, 0.01, 0.03, 0.1, 0.3};
  append(m.exact, gap_coordination(packing, gaps));
  append(m.exact, gap_coordination(with_pushed_rattlers(packing, find_rattlers(packing, 1e-9)), gaps));
  const Pores pores = find_pores(packing);
  append(m.exact, {pores.size, pores.total_area, double(pores.pores.size())});
  std::vector<double> radii;
  for (const Pore& pore : pores.pores) radii.push_back(pore.gyration_radius);
  append(m.exact, radii, true);
  m.on_mesh = scattering(packing).I;
  return m;
}

class StructureInvariance : public testing::Test {
 protected:
  void expect_same(Packing<2> changed) const {
    find_contacts(changed);
    const Measured found = measure(changed);
    ASSERT_EQ(found.exact.size(), reference_.exact.size());
    for (std::size_t k = 0; k < found.exact.size(); ++k)
      EXPECT_NEAR(found.exact[k], reference_.exact[k], 1e-9 * (1.0 + std::abs(reference_.exact[k]))) << k;
    ASSERT_EQ(found.on_mesh.size(), reference_.on_mesh.size());
    for (std::size_t k = 0; k < found.on_mesh.size(); ++k)
      EXPECT_NEAR(found.on_mesh[k], reference_.on_mesh[k], 0.01 * reference_.on_mesh[k]) << k;
  }

  Packing<2> packing_ = loose_packing();
  Measured reference_ = measure(packing_);
};

TEST_F(StructureInvariance, HasSomethingToSee) {
  const Coordination c = coordination(packing_, 1e-9);
  EXPECT_GT(c.n_rattlers, 3);
  EXPECT_LT(c.n_rattlers, 40);
  EXPECT_GT(find_pores(packing_).pores.size(), 20u);
  EXPECT_EQ(find_pores(packing_).failure_reason, "");
}

TEST_F(StructureInvariance, DoesNotSeeTheOrderOfTheGrains) {
  std::vector<int> order(packing_.grains.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  Packing<2> changed = packing_;
  for (int i = 0; i < packing_.grains.size(); ++i) {
    changed.grains.position[i] = packing_.grains.position[order[i]];
    changed.grains.radius[i] = packing_.grains.radius[order[i]];
  }
  expect_same(changed);
}

TEST_F(StructureInvariance, DoesNotSeeWhereTheCellIsCut) {
  Packing<2> changed = packing_;
  for (Vec<2>& x : changed.grains.position) x = changed.cell.wrapped(x + Vec<2>(1.234, -2.7));
  expect_same(changed);
}

TEST_F(StructureInvariance, DoesNotSeeTheChoiceOfLatticeVectors) {
  Packing<2> changed = packing_;
  changed.cell.matrix.row(1) += 2.0 * changed.cell.matrix.row(0);
  changed.cell.matrix.row(0) *= -1.0;
  for (Vec<2>& x : changed.grains.position) x = changed.cell.wrapped(x);
  expect_same(changed);
}

}  // namespace
}  // namespace floc::test
