#include "floc/lattice/cemented_sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/base/error.h"
#include "floc/lattice/grain_forces.h"
#include "floc/lattice/irregular_lattice.h"
#include "floc/lattice/lattice_packing.h"
#include "floc/lattice/node_stress.h"
#include "floc/packing/balance.h"
#include "support/lattice_samples.h"

namespace floc {
namespace {

using test::exactly;
using test::grid_of_grains;
using testing::HasSubstr;

CementedSample<2> cemented(const Packing<2>& packing, double spacing, double content, double gap = 0.12) {
  return cement(packing, triangular_lattice_in(packing.cell, spacing),
                {.matrix_content = content, .bridge_gap = gap});
}

TEST(CementedSample, CountsGrainsAndReachesTheMatrixContentWantedToANode) {
  const Packing<2> packing = grid_of_grains<2>(4, 0.02);
  const double area = solid_fraction(packing);
  for (const double content : {0.0, 0.03, 0.1, 0.2}) {
    const CementedSample<2> s = cemented(packing, 0.04, content);
    EXPECT_NEAR(s.grain_content, area, 2e-3);
    EXPECT_NEAR(s.matrix_content, content, 0.51 / s.lattice.n_nodes());
    for (int k = 0; k < s.lattice.n_nodes(); ++k) {
      if (s.phase[k] == Phase::none) {
        EXPECT_EQ(s.owner[k], -1);
        continue;
      }
      const Vec<2> from =
          s.lattice.node[k] - s.grains.position[s.owner[k]] - s.lattice.cell.shift(s.owner_image[k]);
      EXPECT_EQ(from.norm() < s.grains.radius[s.owner[k]], s.phase[k] == Phase::grain);
      EXPECT_LT(from.norm(), 0.75);
    }
  }
}

TEST(CementedSample, WidensAllBridgesTogether) {
  const Packing<2> packing = grid_of_grains<2>(4, 0.02);
  const CementedSample<2> narrow = cemented(packing, 0.04, 0.03), wide = cemented(packing, 0.04, 0.1);
  EXPECT_EQ(narrow.n_bridges, 32);
  EXPECT_LT(narrow.bridge_width, wide.bridge_width);
  for (int k = 0; k < narrow.lattice.n_nodes(); ++k)
    if (narrow.phase[k] == Phase::matrix) {
      EXPECT_EQ(wide.phase[k], Phase::matrix);
    }
}

TEST(CementedSample, FillsAllVoidsAndSaysWhatIsBeyond) {
  const Packing<2> packing = grid_of_grains<2>(4, 0.02);
  const double most = 1.0 - cemented(packing, 0.04, 0.0).grain_content;
  EXPECT_NEAR(cemented(packing, 0.04, most).matrix_content, most, 1e-9);
  try {
    cemented(packing, 0.04, most + 0.01);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("cannot be reached"));
  }
  EXPECT_THROW(cemented(packing, 0.04, 0.01, 0.0), InputError) << "no neighbours, no bridges";
}

TEST(CementedSample, OverlappingGrainsMeetAtEqualDepths) {
  Packing<2> packing = grid_of_grains<2>(2, -0.1);
  const CementedSample<2> s = cemented(packing, 0.03, 0.0);
  for (int k = 0; k < s.lattice.n_nodes(); ++k) {
    if (s.owner[k] < 0) continue;
    const auto depth = [&](int i, const Vec<2, int>& image) {
      return (s.lattice.node[k] - s.grains.position[i] - s.lattice.cell.shift(image)).norm() -
             s.grains.radius[i];
    };
    const double own = depth(s.owner[k], s.owner_image[k]);
    for (int i = 0; i < s.grains.size(); ++i)
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y) EXPECT_LE(own, depth(i, {x, y}) + 1e-12);
  }
}

/// Checks balances of forces and sum rules, in 2D and 3D.
template <int Dim>
void expect_balance(const Packing<Dim>& packing, const CementedSample<Dim>& sample,
                    const ElementStiffness& stiffness, double sign) {
  const LatticeNetwork<Dim> network = lattice_network(sample, stiffness);
  EXPECT_GT(network.count(ElementKind::bare), 0);
  EXPECT_GT(network.count(ElementKind::interface), 0);
  LatticeSolver<Dim> solver(network, exactly());
  LatticeLoad<Dim> load = LatticeLoad<Dim>::uniaxial(Dim - 1, sign);
  const LatticeSolution<Dim> s = solver.solve(load);
  ASSERT_TRUE(s.report.converged);
  for (int a = 0; a < kSymmetric<Dim>; ++a) EXPECT_NEAR(s.stress[a], load.value[a], 1e-8);

  Mat<Dim> mean = Mat<Dim>::Zero();
  const std::vector<Mat<Dim>> nodes = node_stress(sample.lattice, network, s);
  for (int k = 0; k < sample.lattice.n_nodes(); ++k) {
    mean += sample.lattice.volume[k] / network.volume * nodes[k];
    if (sample.phase[k] == Phase::none) {
      EXPECT_TRUE(nodes[k].isZero());
    }
  }
  Mat<Dim> expected = Mat<Dim>::Zero();
  expected(Dim - 1, Dim - 1) = sign;
  EXPECT_LT((mean - expected).norm(), 1e-8);

  const std::vector<GrainForce<Dim>> forces = grain_forces(sample, network, s);
  const Packing<Dim> grains = packing_of(sample, packing, forces);
  const Balance<Dim> balance = net_forces(grains);
  for (int i = 0; i < grains.grains.size(); ++i) {
    EXPECT_LT(balance.force[i].norm(), 1e-8);
    EXPECT_LT(balance.moment[i].norm(), 1e-8);
  }
  EXPECT_LT((static_stress(grains) - expected).norm(), 1e-8);
  const Packing<Dim> lattice = packing_of(sample.lattice, network, s);
  EXPECT_LT((static_stress(lattice) - expected).norm(), 1e-8);
  double worst = 0.0;
  for (const Vec<Dim>& f : net_forces(lattice).force) worst = std::max(worst, f.norm());
  EXPECT_LT(worst, 1e-8);
}

TEST(LatticeForces, BalanceOnEveryNodeAndGrainAndAddUpToTheStress) {
  const Packing<2> packing = grid_of_grains<2>(3, -0.01);
  const CementedSample<2> sample = cemented(packing, 0.06, 0.08);
  for (const double sign : {1.0, -1.0})
    for (const double shear : {0.0, 0.5}) {
      ElementStiffness stiffness;
      stiffness.grain = 20.0;
      stiffness.shear = shear;
      stiffness.bending = 0.1 * shear;
      expect_balance<2>(packing, sample, stiffness, sign);
    }
}

TEST(LatticeForces, BalanceInSpace) {
  const Packing<3> packing = grid_of_grains<3>(2, -0.01);
  const CementedSample<3> sample = cement(packing, irregular_lattice(packing.cell, {.spacing = 0.16}),
                                          {.matrix_content = 0.15, .bridge_gap = 0.1});
  ElementStiffness stiffness;
  stiffness.grain = 10.0;
  expect_balance<3>(packing, sample, stiffness, 1.0);
}

/// The lattice vector of an axis can be replaced by its opposite. The packing remains the same, and is not mirrored.
TEST(CementedSample, DoesNotDependOnTheSignsOfTheLatticeVectors) {
  const Packing<2> packing = grid_of_grains<2>(4, -0.01);
  const auto strain_of = [&](double x, double y) {
    Packing<2> described = packing;
    described.cell.matrix.row(0) *= x;
    described.cell.matrix.row(1) *= y;
    const CementedSample<2> sample = cemented(described, 0.1, 0.08);
    EXPECT_LT(sample.strain, 0.01);
    LatticeLoad<2> load;
    load.value << 0.2, 1.0, 0.3;
    const LatticeNetwork<2> network = lattice_network(sample, {});
    LatticeSolver<2> solver(network, exactly());
    return Eigen::Vector3d(solver.solve(load).strain);
  };
  const Eigen::Vector3d expected = strain_of(1.0, 1.0);
  EXPECT_LT((strain_of(1.0, -1.0) - expected).norm(), 1e-7 * expected.norm());
  EXPECT_LT((strain_of(-1.0, 1.0) - expected).norm(), 1e-7 * expected.norm());
}

TEST(ForceAgreement, DoesNotDependOnWhereTheCellIsCut) {
  const Packing<2> packing = grid_of_grains<2>(3, -0.01);
  const CementedSample<2> sample = cemented(packing, 0.1, 0.08);
  const LatticeNetwork<2> network = lattice_network(sample, {});
  LatticeSolver<2> solver(network, exactly());
  const auto forces = grain_forces(sample, network, solver.solve(LatticeLoad<2>::uniaxial(1, 1.0)));
  Packing<2> cut = packing_of(sample, packing, forces);
  const std::size_t n = cut.contacts.size();
  std::vector<Vec<2, int>> moved;
  for (Vec<2>& x : cut.grains.position) {
    const Vec<2> from = x + Vec<2>(1.3, 0.7);
    x = cut.cell.wrapped(from);
    moved.push_back(cut.cell.reduced(x - from).array().round().matrix().cast<int>());
  }
  for (Contact<2>& c : cut.contacts) c.image += moved[c.i] - moved[c.j];
  const std::vector<Contact<2>> contacts = contacts_in_images_of(sample, cut);
  std::vector<double> normal;
  for (const Contact<2>& c : contacts) normal.push_back(c.normal_force);
  const ForceAgreement same = agreement(forces, contacts, normal);
  EXPECT_EQ(same.n_common, static_cast<int>(n));
  ASSERT_TRUE(same.pearson);
  EXPECT_NEAR(*same.pearson, 1.0, 1e-12);
  EXPECT_LT(agreement(forces, cut.contacts, normal).n_common, static_cast<int>(n)) << "the images differ";
}

TEST(LatticeNetwork, LeavesOutWhatCanCarryNothing) {
  const Packing<2> packing = grid_of_grains<2>(4, 0.3);  // without bridges every grain is an island
  const CementedSample<2> sample = cemented(packing, 0.08, 0.0);
  const LatticeNetwork<2> network = lattice_network(sample, {});
  EXPECT_TRUE(network.elements.empty());
  EXPECT_EQ(network.n_islands, 16);
  EXPECT_EQ(network.n_directions, 0);
  const CementedSample<2> joined = cemented(packing, 0.08, 0.1, 0.4);
  const LatticeNetwork<2> whole = lattice_network(joined, {});
  EXPECT_EQ(whole.n_directions, 2);
  EXPECT_EQ(whole.n_islands, 0);
  int n_solid = 0, n_present = 0;
  for (const Phase phase : joined.phase) n_solid += phase != Phase::none;
  for (const bool present : whole.present) n_present += present;
  EXPECT_EQ(n_solid, n_present + whole.n_removed);
}

}  // namespace
}  // namespace floc
