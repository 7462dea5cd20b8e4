#include "floc/relaxation/box_relaxer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "floc/assembly/gas.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/least_mechanisms.h"
#include "floc/packing/wall_forces.h"
#include "support/contact_laws.h"

namespace floc {
namespace {

/// Contact law of the published study, in units of diameter, mass and pressure.
/// @param sc  adhesion force f_c
/// @param se  stiffness k_n
Law sticky(double sc, double se, double friction = 0.4) {
  Law law;
  law += test::linear(se);
  law += test::constant_adhesion(sc);
  law += test::viscous_damping(std::sqrt(0.2));
  if (friction > 0.0) law += test::coulomb(friction, 1.5 * se);
  return law;
}

BoxOptions box_of(double friction, double adhesion, double kinetic_pressure = 0.0) {
  BoxOptions box;
  box.mass = 96.0;
  box.friction = friction;
  box.adhesion = adhesion;
  box.kinetic_pressure = kinetic_pressure;
  return box;
}

template <int Dim>
Packing<Dim> boxed_gas(int n, const Law& law, const BoxOptions& box, double solid_fraction) {
  GrainOptions grains;
  grains.count = n;
  grains.diameter.kind = DiameterDistribution::Kind::uniform;
  grains.diameter.min = Dim == 2 ? 0.7 : 1.0;
  grains.diameter.max = 1.0;
  RandomStream random(5, 1);
  return make_boxed_gas<Dim>(grains, law, box, solid_fraction, random);
}

struct End {
  RelaxationStatus status;
  RelaxationReport report;
};

template <int Dim>
End run_to_end(BoxRelaxer<Dim>& relaxer) {
  RelaxationStatus status = RelaxationStatus::running;
  for (int k = 0; status == RelaxationStatus::running && k < 4000; ++k) status = relaxer.advance();
  return {status, relaxer.report()};
}

/// Returns a simple cubic crystal of n^3 frictionless spheres that just touch each other and the walls.
Packing<3> cubic_crystal(int n, const Law& law, const BoxOptions& box) {
  Packing<3> packing;
  packing.law = law;
  packing.grains = Grains<3>::with_size(n * n * n);
  packing.cell.matrix *= n;
  for (int i = 0; i < n * n * n; ++i) {
    packing.grains.position[i] = Vec<3>(i % n + 0.5, i / n % n + 0.5, i / n / n + 0.5);
    packing.grains.radius[i] = 0.5;
    packing.grains.mass[i] = 1.0;
  }
  packing.walls = walls_around<3>(packing, box, Vec<3>::Zero());
  packing.wall_law = wall_law(law, box);
  find_contacts(packing);
  return packing;
}

/// Returns the side L of the crystal at rest, from K_N D - f_c = p L^2/n^2 and L = n d - (n - 1) D - 2 D_w. Here D is
/// the overlap of two spheres, and D_w = D + (f_w - f_c)/K_N is the overlap of a sphere with a wall.
double side_at_rest(int n, double sc, double se, double f_w, double p) {
  double side = n;
  for (int k = 0; k < 50; ++k) {
    const double overlap = (sc + p * side * side / (n * n)) / se;
    side = n - (n - 1) * overlap - 2.0 * (overlap + (f_w - sc) / se);
  }
  return side;
}

struct Crystal {
  int n;
  double f_w;
};
class CubicCrystal : public ::testing::TestWithParam<Crystal> {};

TEST_P(CubicCrystal, BetweenWallsHasTheSideOfItsEquilibrium) {
  const auto [n, f_w] = GetParam();
  const double p = 1.0, sc = 1.0, se = 1e4;  // eta = 1, eta* = 0.01
  const BoxOptions box = box_of(0.0, f_w);
  RelaxationOptions options;
  options.tolerance.stress = CompactionEnd::kSettledPressure;
  options.tolerance.force = options.tolerance.moment = 1e-7;
  BoxRelaxer<3> relaxer(options, cubic_crystal(n, sticky(sc, se, 0.0), box), Vec<3>::Constant(p));
  const End end = run_to_end(relaxer);
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.report.blocking;
  EXPECT_EQ(end.report.ending, "dynamic");
  EXPECT_EQ(end.report.n_mechanisms, 0);
  const double side = side_at_rest(n, sc, se, f_w, p);
  // The pressure on a wall is accurate to 1e-3. The total force on a wall, p L^2 = n^2, is shared by n^2 contacts, so
  // each overlap has an error of 1e-3/K_N.
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(relaxer.packing().cell.matrix(a, a), side, 2e-3 * n / se);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(wall_pressure(relaxer.packing())[a], p, 1e-3 * p);
}

INSTANTIATE_TEST_SUITE_P(Boxes, CubicCrystal,
                         testing::Values(Crystal{1, 1.0}, Crystal{4, 1.0}, Crystal{3, 0.0}));

/// Compares void ratios of the closed form with the published values.
TEST(CubicCrystal, OfOneAndOf64SpheresHasTheVoidRatiosOfTheSpecification) {
  const auto e = [](int n) {
    const double side = side_at_rest(n, 1.0, 1e4, 1.0, 1.0);
    return 6.0 * std::pow(side, 3) / (std::numbers::pi * n * n * n) - 1.0;
  };
  EXPECT_NEAR(e(1), 0.907569, 1e-6);
  EXPECT_NEAR(e(4), 0.908428, 1e-6);
}

/// The energy (3/4) m L'^2 + p L^3 is conserved. If the box starts at rest with the side L0, its side has
/// halved after the time 0.774155 sqrt(m/(p L0)).
TEST(EmptyCube, ClosesAsItsEnergySays) {
  Packing<3> packing = cubic_crystal(1, sticky(1.0, 1e4), box_of(0.0, 0.0));
  const double side = 100.0, p = 1e-2;
  packing.cell.matrix = side * Mat<3>::Identity();
  packing.walls = walls_around<3>(packing, box_of(0.0, 0.0), Vec<3>::Zero());
  packing.grains.position[0] = Vec<3>::Constant(0.5 * side);
  packing.contacts.clear();
  const double time = 0.774155 * std::sqrt(96.0 / (p * side));
  const int n_steps = 2000;
  BoundaryControl<3> control = BoundaryControl<3>::normal_stress(Vec<3>::Constant(p), 1.0);
  const auto dynamics = make_dynamics(packing, control, {time / n_steps, 0.1});
  dynamics->advance(n_steps, Motion::free);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(dynamics->packing().cell.matrix(a, a), 0.5 * side, 1e-3);
}

/// At rest, a sum rule holds for each axis: the contact stress plus the stress due to friction on the parallel walls
/// equals the pressure on the walls across this axis.
template <int Dim>
void expect_sum_rule(const Packing<Dim>& packing, double bound) {
  const Vec<Dim> difference =
      static_stress(packing).diagonal() + stress_borne_by_friction(packing) - wall_pressure(packing);
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), bound);
  // The forces on the walls act on the faces of the box, so the boundary stress equals the contact stress.
  EXPECT_LT((boundary_stress(packing) - static_stress(packing)).cwiseAbs().maxCoeff(), bound);
}

template <int Dim>
class SettledGas : public ::testing::Test {
 protected:
  static constexpr int kDim = Dim;
};
template <class T>
class SettledGasOf : public SettledGas<T::value> {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SettledGasOf, Dimensions);

TYPED_TEST(SettledGasOf, BearsThePressureAndObeysTheSumRule) {
  constexpr int Dim = TypeParam::value;
  const double p = 0.1, se = 1e3;
  const BoxOptions box = box_of(0.4, 0.0, 0.02);
  const Law law = sticky(0.2, se);
  const Packing<Dim> gas = boxed_gas<Dim>(80, law, box, 0.35);
  RelaxationOptions options;
  options.tolerance.stress = CompactionEnd::kSettledPressure;
  options.tolerance.force = options.tolerance.moment = 1e-6;
  options.compaction.longest = 300.0;
  BoxRelaxer<Dim> relaxer(options, gas, Vec<Dim>::Constant(p));
  const End end = run_to_end(relaxer);
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.report.blocking;
  ASSERT_EQ(end.report.ending, "dynamic") << end.report.n_mechanisms << " mechanisms";
  EXPECT_EQ(end.report.n_mechanisms, 0);
  EXPECT_LT(wall_imbalance<Dim>(relaxer.packing(), Vec<Dim>::Constant(p)), 1e-3 * p);
  EXPECT_GT(stress_borne_by_friction(relaxer.packing()).norm(), 1e-3 * p);
  // The tolerance is the error of the stress due to net forces of 1e-6 F1 = 2e-7, which act on 80 grains within a
  // distance of 10 from the origin, in a volume of at least 60.
  expect_sum_rule(relaxer.packing(), 3e-6);
}

TEST(BoxRelaxer, ContinuedFromItsProgressGivesTheSameBits) {
  const BoxOptions box = box_of(0.4, 0.0, 0.02);
  const Packing<2> gas = boxed_gas<2>(60, sticky(0.2, 1e3), box, 0.35);
  RelaxationOptions options;
  BoxRelaxer<2> unbroken(options, gas, Vec<2>(0.1, 0.1));
  for (int k = 0; k < 9; ++k) (void)unbroken.advance();
  BoxRelaxer<2> first(options, gas, Vec<2>(0.1, 0.1));
  for (int k = 0; k < 4; ++k) (void)first.advance();
  const std::string progress = first.progress();
  BoxRelaxer<2> second(options, first.release_packing(), Vec<2>(0.1, 0.1), progress);
  for (int k = 0; k < 5; ++k) (void)second.advance();
  EXPECT_EQ(unbroken.packing().walls, second.packing().walls);
  EXPECT_EQ(unbroken.packing().grains.position, second.packing().grains.position);
  EXPECT_EQ(unbroken.progress(), second.progress());
}

/// The walls of the first axis move until they balance the pressure of the load. The second axis has fixed walls and
/// the third axis is periodic; these two keep their lengths.
TEST(BoxRelaxer, MovesTheWallsUnderPressureAlone) {
  BoxOptions box = box_of(0.4, 0.0, 0.02);
  box.boundary = {BoxSide::walls, BoxSide::fixed, BoxSide::periodic};
  box.sides = Vec<3>(2.0, 1.0, 1.0);
  const Packing<3> gas = boxed_gas<3>(60, sticky(0.2, 1e3), box, 0.35);
  ASSERT_EQ(gas.walls.size(), 4u);
  RelaxationOptions options;
  options.compaction.longest = 20.0;
  BoxRelaxer<3> relaxer(options, gas, Vec<3>::Constant(0.1));
  const End end = run_to_end(relaxer);
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.report.blocking;
  const Packing<3>& rest = relaxer.packing();
  EXPECT_LT(rest.cell.matrix(0, 0), 0.9 * gas.cell.matrix(0, 0));
  EXPECT_EQ(rest.cell.matrix(1, 1), gas.cell.matrix(1, 1));
  EXPECT_EQ(rest.cell.matrix(2, 2), gas.cell.matrix(2, 2));
  EXPECT_NEAR(wall_pressure(rest)[0], 0.1, 0.05);
}

/// If a wall speed is given, the walls move at this speed first, and the pressure acts on them only afterwards.
TEST(BoxRelaxer, ClosesTheBoxAtTheSpeedGiven) {
  const BoxOptions box = box_of(0.4, 0.0, 0.0);
  const Packing<2> gas = boxed_gas<2>(60, sticky(0.0, 1e3), box, 0.35);
  RelaxationOptions options;
  options.compaction.wall_speed = 0.5;
  BoxRelaxer<2> relaxer(options, gas, Vec<2>(0.1, 0.1));
  (void)relaxer.advance();
  const double expected = gas.cell.matrix(0, 0) - 0.5 * relaxer.report().time;
  // Within a chunk of steps, the strain rate is constant: the wall speed divided by the side at the start of the chunk.
  EXPECT_NEAR(relaxer.packing().cell.matrix(0, 0), expected, 0.1 * (gas.cell.matrix(0, 0) - expected));
}

TEST(BoxRelaxer, SaysThatWallsRunAway) {
  Packing<2> gas = boxed_gas<2>(30, sticky(0.0, 1e3), box_of(0.0, 0.0, 100.0), 0.5);
  for (Wall<2>& wall : gas.walls) wall.mass = 0.5;
  RelaxationOptions options;
  BoxRelaxer<2> relaxer(options, gas, Vec<2>(1e-9, 1e-9));
  const End end = run_to_end(relaxer);
  EXPECT_EQ(end.status, RelaxationStatus::gave_up);
  EXPECT_THAT(end.report.blocking, testing::HasSubstr("and no grain touches them"));
}

/// If the walls cannot keep the grains in the box, the relaxer gives up with a message.
TEST(BoxRelaxer, SaysThatGrainsLeaveTheBox) {
  const Packing<2> gas = boxed_gas<2>(30, sticky(0.0, 10.0), box_of(0.0, 0.0, 0.0), 0.5);
  BoxRelaxer<2> relaxer(RelaxationOptions{}, gas, Vec<2>(20.0, 20.0));
  const End end = run_to_end(relaxer);
  EXPECT_EQ(end.status, RelaxationStatus::gave_up);
  EXPECT_THAT(end.report.blocking,
              testing::AnyOf(testing::HasSubstr("beyond a wall"), testing::HasSubstr("closes"),
                             testing::HasSubstr("diverged")));
}

TEST(BoxedGas, KeepsItsRadiusFromWallsAndHasItsKineticPressure) {
  BoxOptions box = box_of(0.4, 0.0, 0.5);
  box.sides = Vec<3>(1.0, 1.0, 1.6);
  const Packing<3> gas = boxed_gas<3>(200, sticky(0.0, 1e3), box, 0.36);
  EXPECT_TRUE(gas.contacts.empty());
  EXPECT_NEAR(solid_fraction(gas), 0.36, 1e-12);
  EXPECT_NEAR(gas.cell.matrix(2, 2) / gas.cell.matrix(0, 0), 1.6, 1e-12);
  double kinetic = 0.0;
  Vec<3> momentum = Vec<3>::Zero();
  for (int i = 0; i < gas.grains.size(); ++i) {
    for (int a = 0; a < 3; ++a) {
      EXPECT_GE(gas.grains.position[i][a], gas.grains.radius[i]);
      EXPECT_LE(gas.grains.position[i][a], gas.cell.matrix(a, a) - gas.grains.radius[i]);
    }
    kinetic += gas.grains.mass[i] * gas.grains.velocity[i].squaredNorm();
    momentum += gas.grains.mass[i] * gas.grains.velocity[i];
  }
  EXPECT_NEAR(kinetic / gas.cell.volume(), 0.5, 1e-12);
  EXPECT_LT(momentum.norm(), 1e-10);
}

}  // namespace
}  // namespace floc
