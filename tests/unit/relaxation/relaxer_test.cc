#include "floc/relaxation/relaxer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "floc/neighbors/find_contacts.h"
#include "floc/neighbors/pairs.h"
#include "floc/packing/balance.h"
#include "floc/relaxation/static_solver.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"

namespace floc {
namespace {

RelaxationOptions options() {
  RelaxationOptions o;
  o.strain_rate_cap = 0.05;
  return o;
}

/// Runs a relaxer until it ends, and returns the relaxer.
Relaxer<2> run_to_end(const RelaxationOptions& with, const Packing<2>& start, double pressure) {
  Relaxer<2> relaxer(with, start, Vec<2>::Constant(pressure));
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) status = relaxer.advance();
  EXPECT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
  return relaxer;
}

Packing<2> relaxed(const Packing<2>& start, double pressure) {
  return run_to_end(options(), start, pressure).packing();
}

/// Equilibrium that several tests use.
const Packing<2>& equilibrium() {
  static const Packing<2> packing = relaxed(test::gas_of(60, test::cohesive_law(), 0.5), 0.1);
  return packing;
}

TEST(Relaxer, ReachesAllFourCriteria) {
  const Residuals r = residuals(equilibrium(), Vec<2>(0.1, 0.1));
  EXPECT_TRUE(r.within(EquilibriumTolerance{}));
  EXPECT_LT(r.force, 1e-8);  // target of the Newton refinement
}

TEST(Relaxer, TheForcesAcrossTheFacesOfTheCellAreTheStress) {
  const Mat<2> stress = static_stress(equilibrium());
  // The two stresses differ by at most 5e-8, because net forces of 1e-8 act on 60 grains within a distance of 5 from
  // the centre of a cell of area 70.
  EXPECT_LT((boundary_stress(equilibrium()) - stress).cwiseAbs().maxCoeff(), 5e-8);
  // error of the stress after the Newton refinement, in F0/a
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(stress(a, a), 0.1, 1e-8);
}

TEST(Relaxer, ContinuedFromItsProgressGivesTheSameBits) {
  const Packing<2> gas = test::gas_of(60, test::cohesive_law(), 0.5);
  const Vec<2> target(0.1, 0.1);
  Relaxer<2> unbroken(options(), gas, target);
  for (int k = 0; k < 7; ++k) (void)unbroken.advance();
  const Relaxer<2> stopped = unbroken;
  for (int k = 0; k < 9; ++k) (void)unbroken.advance();
  Relaxer<2> continued(options(), stopped.packing(), target, relaxation_progress(stopped.progress()));
  for (int k = 0; k < 9; ++k) (void)continued.advance();
  EXPECT_EQ(continued.packing().grains.position, unbroken.packing().grains.position);
  EXPECT_EQ(continued.packing().grains.velocity, unbroken.packing().grains.velocity);
  EXPECT_EQ(continued.progress(), unbroken.progress());
}

TEST(Relaxer, ACellLighterThanAGrainComesToRest) {
  RelaxationOptions with = options();
  with.cell_mass = 1e-3;  // 0.06 times the mass of a grain: the cell vibrates faster than contacts
  const Packing<2> after = run_to_end(with, equilibrium(), 0.2).packing();
  EXPECT_TRUE(residuals(after, Vec<2>(0.2, 0.2)).within(EquilibriumTolerance{}));
}

TEST(Relaxer, ASmallIncrementIsNotEquilibriumBeforeTheCellHasMoved) {
  RelaxationOptions by_motion = options();
  by_motion.finish = Finish::dynamic;
  by_motion.tolerance.stress = 1e-6;
  const Packing<2> after = run_to_end(by_motion, equilibrium(), 0.11).packing();
  const Mat<2> stress = static_stress(after);
  EXPECT_NEAR(stress(0, 0), 0.11, 1e-6);
  EXPECT_NEAR(stress(1, 1), 0.11, 1e-6);
}

TEST(Relaxer, AStaticStepEndsWhereMotionEnds) {
  const Relaxer<2> at_once = run_to_end(options(), equilibrium(), 0.1005);
  EXPECT_EQ(at_once.report().ending, "static");
  EXPECT_EQ(at_once.report().n_steps, 0);
  RelaxationOptions by_motion = options();
  by_motion.finish = Finish::dynamic;
  by_motion.tolerance.force = by_motion.tolerance.moment = by_motion.tolerance.stress = 1e-8;
  const Relaxer<2> moved = run_to_end(by_motion, equilibrium(), 0.1005);
  EXPECT_GT(moved.report().n_steps, 0);
  const auto& contacts = at_once.packing().contacts;
  ASSERT_EQ(contacts.size(), moved.packing().contacts.size());
  double largest_change = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact<2>&p = contacts[k], &q = moved.packing().contacts[k];
    ASSERT_EQ(std::tie(p.i, p.j), std::tie(q.i, q.j));
    // Contact forces are of order 1. Errors of 1e-8 in the net forces on grains cause errors of about 1e-6 in contact
    // forces, because some directions are soft.
    EXPECT_NEAR(p.normal_force, q.normal_force, 1e-5);
    EXPECT_NEAR((p.shear_force - q.shear_force).norm(), 0.0, 1e-5);
    largest_change =
        std::max(largest_change, std::abs(p.normal_force - equilibrium().contacts[k].normal_force));
  }
  EXPECT_GT(largest_change, 1e-3);
}

TEST(Relaxer, LeavesToMotionWhereVibrationsWouldSlideUnlessTheSceneTakesAnyEquilibrium) {
  const auto at_once = [](Finish finish, double pressure) {
    RelaxationOptions with = options();
    with.finish = finish;
    Relaxer<2> relaxer(with, equilibrium(), Vec<2>::Constant(pressure));
    return relaxer.advance() == RelaxationStatus::converged;
  };
  int left_to_motion = 0;
  for (int k = 1; k <= 15; ++k) {
    const double pressure = 0.1 + 0.01 * k;
    EXPECT_FALSE(at_once(Finish::dynamic, pressure));
    const bool any = at_once(Finish::statics, pressure);
    const bool only_springs = at_once(Finish::automatic, pressure);
    EXPECT_LE(only_springs, any) << pressure;
    left_to_motion += any && !only_springs;
  }
  EXPECT_GT(left_to_motion, 0);
}

TEST(Relaxer, SaysWhichCriterionBlocks) {
  Relaxer<2> relaxer(options(), equilibrium(), Vec<2>::Constant(0.5));
  EXPECT_EQ(relaxer.report().blocking.substr(0, 6), "stress");
}

TEST(StaticSolver, ReturnsToEquilibriumFromASmallDisturbance) {
  Packing<2> disturbed = equilibrium();
  RandomStream random(5, 1);
  for (Vec<2>& x : disturbed.grains.position)
    for (int a = 0; a < 2; ++a)
      x[a] += 2e-9 * random.normal();  // overlaps are 1e-5, so no spring crosses its limit
  const Vec<2> target(0.1, 0.1);
  const StaticSolution<2> solution = solve_statics(disturbed, target, StaticSolverOptions{});
  ASSERT_TRUE(solution.converged) << solution.reason;
  EXPECT_LE(solution.iterations, 5);  // convergence is quadratic, because the tangent is the exact derivative
  EXPECT_LT(residuals(solution.packing, target).force, 1e-8);
}

TEST(StaticSolver, SaysWhyItFailsFarFromEquilibrium) {
  const Packing<2> gas = test::gas_of(60, test::cohesive_law(), 0.5);
  const StaticSolution<2> solution = solve_statics(gas, Vec<2>(0.1, 0.1), StaticSolverOptions{});
  EXPECT_FALSE(solution.converged);
  EXPECT_FALSE(solution.reason.empty());
}

TEST(Relaxer, SaysThatTheMotionDiverged) {
  Packing<2> wild = test::agitated_gas(60, test::cohesive_law());
  wild.grains.velocity[0][0] = std::numeric_limits<double>::infinity();
  Relaxer<2> relaxer(options(), wild, Vec<2>::Constant(0.1));
  EXPECT_EQ(relaxer.advance(), RelaxationStatus::gave_up);
  EXPECT_NE(relaxer.report().blocking.find("diverged"), std::string::npos) << relaxer.report().blocking;
}

TEST(Relaxer, IsNotHeldUpByRattlersThatSpin) {
  Packing<2> start = equilibrium();
  Grains<2>& g = start.grains;
  g.position_low.clear();  // the added grain has no second double of its position
  // A grain of normal size would touch other grains even in the largest hole. A tiny grain, which spins, fits in
  // without contacts.
  const Packing<2> rest = start;
  for (double x = 0.0; g.size() == rest.grains.size(); x += 0.01) {
    Grains<2> trial = rest.grains;
    trial.position.push_back(Vec<2>(x, 0.37 * x));
    trial.velocity.push_back(Vec<2>::Zero());
    trial.radius.push_back(0.02);
    trial.mass.push_back(0.0016);
    trial.orientation.push_back(0.0);
    trial.angular_velocity.push_back(RotationVector<2>(30.0));
    if (find_pairs(start.cell, trial, 0.01).size() == find_pairs(rest.cell, rest.grains, 0.01).size())
      g = trial;
  }
  EXPECT_GT(residuals(start, Vec<2>(0.1, 0.1)).energy, EquilibriumTolerance{}.energy);
  RelaxationOptions coarse = options();
  // two contact times of the tiny grain, which is about the usual step for the other grains
  coarse.time_step = 2.0;
  Relaxer<2> relaxer(coarse, start, Vec<2>::Constant(0.1));
  RelaxationStatus status = RelaxationStatus::running;
  for (int k = 0; k < 400 && status == RelaxationStatus::running; ++k) status = relaxer.advance();
  EXPECT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
}

TEST(StrainRateCap, FollowsTheUnitTheSceneNames) {
  const Packing<2> cohesive = test::gas_of(10, test::cohesive_law(), 0.3);
  EXPECT_NEAR(strain_rate_cap(options(), cohesive, Vec<2>(Vec<2>::Constant(4.0))), 0.05, 1e-15);
  Law law;
  law += test::linear(1.0);
  RelaxationOptions inertial;
  inertial.inertial_number_cap = 1e-3;
  EXPECT_NEAR(strain_rate_cap(inertial, test::gas_of(10, law, 0.3), Vec<2>(Vec<2>::Constant(4e-4))), 2e-5,
              1e-18);
}

/// Returns a triangular crystal of frictionless adhesive disks with a hole. Three larger disks form a chain across the
/// hole. The chain is longer than the hole is wide, so it can swing.
Packing<2> swinging_chain(double speed) {
  Packing<2> packing;
  packing.law = test::cohesive_law();
  packing.law += test::linear(1e4);
  packing.law += test::without("friction");
  packing.law += test::without("rolling");
  constexpr double kOverlap = 1e-4, kDistance = 1.0 - kOverlap, kRow = 0.8660254037844386 * kDistance;
  constexpr int kColumns = 8, kRows = 8, kMiddle = 4;
  packing.cell.matrix << kColumns * kDistance, 0.0, 0.0, kRows * kRow;
  std::vector<Vec<2>> places, velocities;
  std::vector<double> radii;
  const auto add = [&](const Vec<2>& place, const Vec<2>& velocity, double radius) {
    places.push_back(place);
    velocities.push_back(velocity);
    radii.push_back(radius);
  };
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const double x = column + 0.5 * (row % 2);
      if (std::abs(row - kMiddle) <= 2 && x > 1.0 && x < 5.0) continue;
      add({x * kDistance, row * kRow}, Vec<2>::Zero(), 0.5);
    }
  constexpr double kLarger = 0.515, kRise = 0.25;
  const double outer = 0.5 + kLarger - kOverlap, inner = 2.0 * kLarger - kOverlap;
  const double x = std::sqrt(outer * outer - kRise * kRise), half = 2.0 * kDistance - x;
  const double rise = std::sqrt(inner * inner - half * half);
  const Vec<2> end(kDistance, kMiddle * kRow);
  // The velocities keep the distances of neighbours constant: the outer disks rotate about the ends of the chain, and
  // the middle disk moves up or down.
  const double turn = speed / outer;
  const double up = turn * (x - kRise * half / rise);
  add(end + Vec<2>(x, kRise), turn * Vec<2>(-kRise, x), kLarger);
  add(end + Vec<2>(x + half, kRise + rise), {0.0, up}, kLarger);
  add(end + Vec<2>(x + 2.0 * half, kRise), turn * Vec<2>(kRise, x), kLarger);
  packing.grains = Grains<2>::with_size(static_cast<int>(places.size()));
  packing.grains.position = places;
  packing.grains.velocity = velocities;
  packing.grains.radius = radii;
  for (std::size_t k = 0; k < radii.size(); ++k) packing.grains.mass[k] = 4.0 * radii[k] * radii[k];
  find_contacts(packing);
  return packing;
}

/// Nothing damps the swinging chain. The energy of the chain alone exceeds the tolerance for an equilibrium.
TEST(Relaxer, EndsWhereChainsSwingForEver) {
  const Packing<2> start = swinging_chain(0.01);
  const double energy = residuals(start, Vec<2>(Vec<2>::Constant(0.1))).energy;
  ASSERT_GT(energy, 10 * EquilibriumTolerance{}.energy);
  LoadTarget<2> load;
  load.side = start.cell.matrix.diagonal();
  RelaxationOptions with = options();
  with.max_time = 300.0;
  Relaxer<2> relaxer(with, start, load);
  RelaxationStatus status = RelaxationStatus::running;
  double energy_at_200 = 0.0;
  while (status == RelaxationStatus::running) {
    status = relaxer.advance();
    if (relaxer.report().time < 200.0) energy_at_200 = relaxer.report().residuals.energy;
  }
  EXPECT_GT(energy_at_200, 2 * EquilibriumTolerance{}.energy);
  EXPECT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
  EXPECT_TRUE(relaxer.report().residuals.within(EquilibriumTolerance{}));
}

}  // namespace
}  // namespace floc
