#include <gtest/gtest.h>

#include <cmath>

#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/relaxation_options.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/kernel_pair.h"

namespace floc {
namespace {

using test::agitated_gas;
using test::cohesive_law;
using test::KernelPair;

TEST(Spheres, ListsLeaveNoTraceInTheBits) {
  test::expect_no_trace_of_lists<3>();
}

TEST(Spheres, ThreadsLeaveNoTraceInTheBits) {
  test::expect_no_trace_of_threads<3>();
}

TEST(Spheres, PlacesOfRowsLeaveNoTraceInTheBits) {
  Law frictionless = cohesive_law();
  frictionless += test::without("friction");
  frictionless += test::without("rolling");
  for (const Law& law : {cohesive_law(), frictionless})
    test::expect_no_trace_of_kept_rows(test::large_agitated_gas<3>(law));
}

TEST(Spheres, VectorInstructionsLeaveNoTraceInTheBits) {
  test::expect_no_trace_of_instructions<3>(30u);
}

/// Other vectors of the same lattice describe the same periodic boundary, so the motion does not change.
TEST(Spheres, MoveAlikeInLatticesOfOtherVectors) {
  Packing<3> gas = agitated_gas<3>(150, cohesive_law());
  Packing<3> leaning = gas;
  leaning.cell.matrix(2, 1) = gas.cell.matrix(1, 1);
  const double dt = time_step_of(gas, RelaxationOptions{}.time_step);
  const auto fixed = BoundaryControl<3>::fixed();
  const auto straight = make_dynamics(gas, fixed, {dt, 0.05});
  const auto skewed = make_dynamics(leaning, fixed, {dt, 0.05});
  straight->advance(100, Motion::free);
  skewed->advance(100, Motion::free);
  const Packing<3> p = straight->packing(), q = skewed->packing();
  ASSERT_GT(p.contacts.size(), 5u);
  EXPECT_EQ(p.contacts.size(), q.contacts.size());
  for (int i = 0; i < gas.grains.size(); ++i) {
    EXPECT_LT((p.grains.velocity[i] - q.grains.velocity[i]).norm(), 1e-9);
    EXPECT_LT((p.grains.angular_velocity[i] - q.grains.angular_velocity[i]).norm(), 1e-8);
  }
}

/// Two spinning spheres collide off centre. Momentum and angular momentum are conserved up to rounding, because
/// the two lever arms add up to the branch.
TEST(Spheres, ACollisionConservesAngularMomentum) {
  Packing<3> pair;
  pair.law = cohesive_law();
  pair.cell.matrix *= 10.0;
  pair.grains = Grains<3>::with_size(2);
  pair.grains.position = {Vec<3>(4.0, 5.0, 5.0), Vec<3>(4.8, 5.2, 5.1)};
  pair.grains.velocity = {Vec<3>(0.7, 0.1, 0.0), Vec<3>(-0.3, 0.0, 0.2)};
  pair.grains.angular_velocity = {Vec<3>(0.1, -2.0, 0.4), Vec<3>(3.0, 0.2, 1.0)};
  pair.grains.radius = {0.5, 0.25};
  pair.grains.mass = {1.0, 0.125};
  const auto angular_momentum = [](const Packing<3>& p) {
    Vec<3> sum = Vec<3>::Zero();
    for (int i = 0; i < 2; ++i)
      sum += p.grains.mass[i] * p.grains.position[i].cross(p.grains.velocity[i]) +
             p.grains.inertia(i) * p.grains.angular_velocity[i];
    return sum;
  };
  const double dt = time_step_of(pair, RelaxationOptions{}.time_step);
  const auto dynamics = make_dynamics(pair, BoundaryControl<3>::fixed(), {dt, 0.05});
  dynamics->advance(500, Motion::free);
  const Packing<3> end = dynamics->packing();
  EXPECT_GT((end.grains.angular_velocity[0] - pair.grains.angular_velocity[0]).norm(), 0.05);
  EXPECT_LT((angular_momentum(end) - angular_momentum(pair)).norm(), 1e-12);
}

/// If a sphere spins freely about one axis, its orientation q follows the angle of rotation.
TEST(Spheres, OrientationFollowsTheSpin) {
  Packing<3> one;
  one.law = cohesive_law();
  one.cell.matrix *= 10.0;
  one.grains = Grains<3>::with_size(1);
  one.grains.position[0].setConstant(5.0);
  one.grains.angular_velocity[0] = Vec<3>(0.3, -1.0, 0.5);
  one.grains.radius = {0.5};
  one.grains.mass = {1.0};
  const auto dynamics = make_dynamics(one, BoundaryControl<3>::fixed(), {1e-3, 0.05});
  dynamics->advance(2000, Motion::free);
  const Vec<3> spin = one.grains.angular_velocity[0];
  const Eigen::Quaterniond exact(Eigen::AngleAxisd(2.0 * spin.norm(), spin.normalized()));
  EXPECT_LT(dynamics->packing().grains.orientation[0].angularDistance(exact), 1e-6);
}

Law frictional_law() {
  Law law;
  law += test::linear(1.0);
  law += test::coulomb(100.0, 0.7);
  return law;
}

/// Tangential force of a pair after a rigid rotation of the pair, compared with the start.
struct Turned {
  double length;  ///< magnitude of the force, divided by the magnitude at the start
  double angle;   ///< angle between the two forces (radians)
};
Turned turned_rigidly(const Vec<3>& axis, int n, InstructionSet set) {
  KernelPair pair(frictional_law(), 1e-3, set);
  pair.slip(Vec<3>(0.0, 0.1, 0.0));
  const Vec<3> start = pair.tangential_force();
  const Vec<3> x_i = pair.position(0), x_j = pair.position(1);
  const double dt = 1.0;
  for (int k = 1; k <= n; ++k) {
    const Eigen::AngleAxisd turn(axis.norm() * k / n, axis.normalized());
    pair.move({turn * x_i, turn * x_j}, {axis / n, axis / n}, dt);
  }
  const Vec<3> exact = Eigen::AngleAxisd(axis.norm(), axis.normalized()) * start;
  const Vec<3> end = pair.tangential_force();
  return {end.norm() / start.norm(), std::atan2(end.cross(exact).norm(), end.dot(exact))};
}

TEST(Spheres, ARigidTurnKeepsTheTangentialForce) {
  const Vec<3> axis(0.3, 0.4, 1.2);
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!supported(set)) continue;
    const Turned coarse = turned_rigidly(axis, 500, set), fine = turned_rigidly(axis, 1000, set);
    EXPECT_NEAR(fine.length, 1.0, 3e-6);  // the chord of each step is shorter than its arc
    EXPECT_LT(fine.angle, 4e-6);
    EXPECT_NEAR(coarse.angle / fine.angle, 4.0, 0.2);
  }
}

TEST(Spheres, TheTangentialForceTurnsWithTheMeanSpinAboutTheNormal) {
  const auto end_of = [](double spin_i, double spin_j) {
    KernelPair pair(frictional_law(), 1e-3, widest_instruction_set());
    pair.slip(Vec<3>(0.0, 1e-4, 0.0));
    for (int k = 0; k < 1000; ++k)
      pair.move({pair.position(0), pair.position(1)}, {Vec<3>(spin_i, 0.0, 0.0), Vec<3>(spin_j, 0.0, 0.0)},
                1e-3);
    return Vec<3>(pair.tangential_force() / (0.7e-4));
  };
  EXPECT_LT((end_of(0.8, 0.8) - Vec<3>(0.0, std::cos(0.8), std::sin(0.8))).norm(), 1e-7);
  EXPECT_LT((end_of(0.8, -0.8) - Vec<3>(0.0, 1.0, 0.0)).norm(), 1e-12);
}

/// When spheres rotate like gears, neither the magnitude nor the direction of the tangential force changes.
TEST(Spheres, GearsKeepTheTangentialForce) {
  KernelPair pair(frictional_law(), 1e-3, widest_instruction_set());
  pair.slip(Vec<3>(0.0, 1e-4, 0.0));
  const Vec<3> before = pair.tangential_force();
  for (int k = 0; k < 100; ++k)
    pair.move({pair.position(0), pair.position(1)}, {Vec<3>(0.0, 0.3, 0.2), Vec<3>(0.0, -0.3, -0.2)}, 1e-2);
  EXPECT_LT((pair.tangential_force() - before).norm(), 1e-16);
}

TEST(Spheres, MomentsOfAContactAreThoseOfItsShearForce) {
  KernelPair pair(frictional_law(), 1e-3, widest_instruction_set());
  pair.slip(Vec<3>(0.0, 1e-4, -2e-4));
  EXPECT_NEAR(pair.normal_force(), 1e-3, 1e-15);
  EXPECT_LT((pair.tangential_force() - 0.7 * Vec<3>(0.0, 1e-4, -2e-4)).norm(), 1e-16);
  const double arm = 0.5 * (1.0 - 1e-3);
  const Vec<3> unit = pair.normal().cross(pair.tangential_force());
  EXPECT_LT((pair.moment_on_i() - arm * unit).norm(), 1e-16);
  EXPECT_LT((pair.moment_on_j() - arm * unit).norm(), 1e-16);
}

/// Rolling resistance acts only on rotations about axes in the tangent plane.
TEST(Spheres, RollingResistsRotationsAboutTangentsOnly) {
  Law law = frictional_law();
  law += test::rolling_spring(100.0, 0.3);
  KernelPair pair(law, 1e-3, widest_instruction_set());
  pair.move({pair.position(0), pair.position(1)}, {Vec<3>(0.2, 1e-3, 2e-3), Vec<3>(-0.3, -1e-3, -2e-3)}, 1.0);
  EXPECT_LT(pair.tangential_force().norm(), 1e-16);
  EXPECT_LT((pair.moment_on_j() - 0.3 * Vec<3>(0.0, 2e-3, 4e-3)).norm(), 1e-16);
  EXPECT_EQ(pair.moment_on_i(), -pair.moment_on_j());
}

/// Twisting resistance acts only on rotations about the normal. Each resistance has its own limit.
TEST(Spheres, TwistingResistsRotationsAboutTheNormalOnly) {
  Law law = frictional_law();
  law += test::twisting_spring(0.1, 0.3);  // the limit is a fraction 0.3 of a normal force of 1e-3
  KernelPair pair(law, 1e-3, widest_instruction_set());
  const std::array<Vec<3>, 2> still = {pair.position(0), pair.position(1)};
  pair.move(still, {Vec<3>(2e-4, 1e-3, 2e-3), Vec<3>(-1e-4, -1e-3, -2e-3)}, 1.0);
  EXPECT_LT((pair.moment_on_j() - 0.3 * Vec<3>(3e-4, 0.0, 0.0)).norm(), 1e-18);
  EXPECT_EQ(pair.moment_on_i(), -pair.moment_on_j());
  pair.move(still, {Vec<3>(0.2, 0.0, 0.0), Vec<3>(-0.3, 0.0, 0.0)}, 1.0);
  EXPECT_LT((pair.moment_on_j() - Vec<3>(1e-4, 0.0, 0.0)).norm(), 1e-18);
}

/// The springs for rolling and twisting rotate with the pair, so a rigid rotation does not change the magnitude of
/// their moment.
TEST(Spheres, ARigidTurnKeepsTheMoment) {
  Law law = frictional_law();
  law += test::rolling_spring(100.0, 0.3);
  law += test::twisting_spring(100.0, 0.2);
  const Vec<3> axis(0.3, 0.4, 1.2);
  const auto turned = [&](int n) {
    KernelPair pair(law, 1e-3, widest_instruction_set());
    const Vec<3> x_i = pair.position(0), x_j = pair.position(1);
    const Vec<3> rotation(0.02, -0.01, 0.03);
    pair.move({x_i, x_j}, {rotation, -rotation}, 1.0);
    // The moment of the shear force is the same on both spheres, so it cancels in this difference.
    const auto of_springs = [&] { return Vec<3>(0.5 * (pair.moment_on_j() - pair.moment_on_i())); };
    const Vec<3> start = of_springs();
    EXPECT_LT((start - 2.0 * Vec<3>(0.2 * 0.02, -0.3 * 0.01, 0.3 * 0.03)).norm(), 1e-16);
    for (int k = 1; k <= n; ++k) {
      const Eigen::AngleAxisd turn(axis.norm() * k / n, axis.normalized());
      pair.move({turn * x_i, turn * x_j}, {axis / n, axis / n}, 1.0);
    }
    const Vec<3> exact = Eigen::AngleAxisd(axis.norm(), axis.normalized()) * start;
    EXPECT_NEAR(of_springs().norm(), start.norm(), 1e-12 * start.norm());
    return (of_springs() - exact).norm() / start.norm();
  };
  const double coarse = turned(500), fine = turned(1000);
  EXPECT_LT(fine, 1e-5);
  EXPECT_NEAR(coarse / fine, 4.0, 0.3);
}

TEST(Spheres, AFrictionalGasRelaxesToEquilibrium) {
  Law law;
  law += test::linear(1.0);
  law += test::viscous_damping(0.1);
  law += test::coulomb(0.3, 0.8);
  const Packing<3> gas = test::gas_of<3>(120, law, 0.45);
  const Vec<3> target = Vec<3>::Constant(1e-3);
  RelaxationOptions options;
  options.inertial_number_cap = 1e-2;
  const auto relaxer = make_equilibrator<3>(options, gas, target);
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) status = relaxer->advance();
  ASSERT_EQ(status, RelaxationStatus::converged) << relaxer->report().blocking;
  const Residuals left = residuals(relaxer->packing(), target);
  EXPECT_LT(left.force, options.tolerance.force);
  EXPECT_LT(left.moment, options.tolerance.moment);
  EXPECT_LT(left.stress, options.tolerance.stress);
  EXPECT_LT(left.energy, options.tolerance.energy);
  EXPECT_EQ(relaxer->report().stability.n_negative, 0);
  EXPECT_GT(solid_fraction(relaxer->packing()), 0.55);
}

}  // namespace
}  // namespace floc
