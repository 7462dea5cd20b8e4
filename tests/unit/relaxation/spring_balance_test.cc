#include "floc/relaxation/spring_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "floc/packing/balance.h"
#include "floc/rigid/contact_points.h"
#include "floc/rigid/elastic_contacts.h"
#include "support/elastic_gas.h"

namespace floc::test {
namespace {

constexpr double kBalanced = 1e-9;

template <int Dim>
LoadTarget<Dim> unit_pressure() {
  return LoadTarget<Dim>::normal_stress(Vec<Dim>::Ones());
}

template <int Dim>
double largest_residual(const Packing<Dim>& packing) {
  const Residuals r = residuals(packing, Vec<Dim>(Vec<Dim>::Ones()), static_stress(packing));
  return std::max({r.force, r.moment, r.stress});
}

/// Returns a packing after random displacements of its grains by at most `size` along each axis and, in 2D, rotations by
/// at most this angle.
template <int Dim>
Packing<Dim> shaken(const Packing<Dim>& rested, double size) {
  Packing<Dim> out = rested;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-size, size);
  for (int i = 0; i < out.grains.size(); ++i) {
    for (int a = 0; a < Dim; ++a) out.grains.position[i][a] += move(random);
    if constexpr (Dim == 2) out.grains.orientation[i] += move(random);
  }
  out.contacts = ContactPoints<Dim>().find(out, 0.0);
  carry_forces(out, rested.contacts, out.contacts);
  set_spring_forces(out);
  return out;
}

template <int Dim>
void expect_balance_restored(int count, const ShapeOptions& shape, double friction) {
  SCOPED_TRACE(testing::Message() << Dim << " dimensions, friction " << friction);
  const RigidEnd<Dim> rested = relaxed(elastic_gas<Dim>(count, shape, 1e4, friction));
  ASSERT_EQ(rested.status, RelaxationStatus::converged) << rested.reason;
  const Packing<Dim> start = shaken(rested.packing, 1e-6);
  EXPECT_GT(largest_residual(start), 1e-3);
  const SpringBalance<Dim> found = balance_springs(start, unit_pressure<Dim>(), kBalanced);
  EXPECT_TRUE(found.converged);
  EXPECT_LT(largest_residual(found.packing), kBalanced);
  for (const Contact<Dim>& c : found.packing.contacts) {
    EXPECT_NEAR(c.normal_force, -1e4 * c.gap, 1e-9);
    EXPECT_LE(c.shear_force.norm(), friction * c.normal_force * (1.0 + 1e-9));
  }
  for (int i = 0; i < start.grains.size(); ++i) EXPECT_TRUE(found.packing.grains.velocity[i].isZero(0.0)) << i;
}

/// With a wrong tangent matrix, twelve iterations would not reduce the residual by the factor 1e6. Without friction some
/// contacts have no tangential springs; with the friction 0.3 some slide.
TEST(SpringBalance, NewtonIterationsRestoreABalance) {
  for (const double friction : {0.0, 0.3, 100.0}) {
    expect_balance_restored<2>(30, {.kind = PolygonOptions{5}, .rounding = 0.05}, friction);
    expect_balance_restored<2>(30, {.kind = CapsuleOptions{2.0}}, friction);
  }
  for (const double friction : {0.3, 100.0})
    expect_balance_restored<3>(16, {.kind = CutOptions{}, .rounding = 0.05, .count = 10}, friction);
}

TEST(SpringBalance, ImposedLengthsStay) {
  const RigidEnd<2> rested = relaxed(elastic_gas<2>(30, {.kind = PolygonOptions{5}}, 1e4, 0.5));
  ASSERT_EQ(rested.status, RelaxationStatus::converged) << rested.reason;
  LoadTarget<2> load = unit_pressure<2>();
  load.stress[1] = 1.0 + 1e-3;
  load.side[0] = rested.packing.cell.matrix(0, 0);
  const SpringBalance<2> found = balance_springs(rested.packing, load, kBalanced);
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.packing.cell.matrix(0, 0), load.side[0]);
  EXPECT_LT(found.packing.cell.matrix(1, 1), rested.packing.cell.matrix(1, 1));
  EXPECT_NEAR(static_stress(found.packing)(1, 1), load.stress[1], kBalanced);
}

/// A grain that is displaced by a twentieth of a diameter overlaps its neighbours deeply: there is no balance nearby, and
/// the residual must not grow.
TEST(SpringBalance, SaysThatThereIsNoBalance) {
  RigidEnd<2> rested = relaxed(elastic_gas<2>(30, {.kind = PolygonOptions{5}}, 1e4, 0.5));
  ASSERT_EQ(rested.status, RelaxationStatus::converged) << rested.reason;
  Packing<2> start = rested.packing;
  const int loaded = start.contacts.front().i;
  for (int a = 0; a < 2; ++a) start.grains.position[static_cast<std::size_t>(loaded)][a] += 0.05;
  start.contacts = ContactPoints<2>().find(start, 0.0);
  set_spring_forces(start);
  const SpringBalance<2> found = balance_springs(start, unit_pressure<2>(), kBalanced);
  EXPECT_FALSE(found.converged);
  EXPECT_LE(largest_residual(found.packing), largest_residual(start));
}

}  // namespace
}  // namespace floc::test
