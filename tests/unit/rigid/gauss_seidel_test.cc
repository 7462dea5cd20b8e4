#include "floc/rigid/gauss_seidel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/step_contacts.h"

namespace floc::test {
namespace {

constexpr double kTolerance = 1e-13;

TEST(GaussSeidel, CarriesAStackOfDisksInTheFirstStep) {
  constexpr int kDisks = 20;
  constexpr double kMass = 2.0, kGravity = 3.0, kStep = 0.1;
  std::vector<StepContact<2>> contacts = stack_of_disks(kDisks);
  const auto solve = [&] {
    BodyMotion<2> bodies = balls_and_ground<2>(kDisks, kMass, 0.5);
    for (int k = 0; k < kDisks; ++k) bodies.velocity[k] = {0.0, -kStep * kGravity};
    const SweepResult result = GaussSeidel<2>(bodies, contacts).solve(kTolerance, 10'000, 1);
    EXPECT_TRUE(result.converged);
    for (int k = 0; k < kDisks; ++k)
      EXPECT_NEAR(contacts[k].impulse[0] / kStep, (k + 1) * kMass * kGravity, 1e-8);
    return result.n_sweeps;
  };
  // In a stack of n disks, each plain sweep multiplies the error of the slowest mode by exp(-pi^2/(4 n^2)). With
  // conjugate directions, this factor is about exp(-pi/n).
  const double plain =
      4.0 / (std::numbers::pi * std::numbers::pi) * kDisks * kDisks * std::log(1.0 / kTolerance);
  EXPECT_LT(solve(), 0.15 * plain);
  // These sweeps start from the solution and only have to remove its remaining error.
  EXPECT_LT(solve(), 100);
}

TEST(GaussSeidel, BallsInARowTakeTheImpulsesOfTheClosedForm) {
  constexpr int kBalls = 3;
  constexpr double kMass = 1.5, kVelocity = 2.0;
  for (const double restitution : {0.0, 0.5, 1.0}) {
    BodyMotion<3> bodies = balls_and_ground<3>(kBalls, kMass, 0.5);
    bodies.velocity[0] = {kVelocity, 0.0, 0.0};
    std::vector<StepContact<3>> contacts;
    for (int k = 0; k + 1 < kBalls; ++k) {
      contacts.push_back(touching<3>(k, k + 1, {0.5, 0.0, 0.0}, {-0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0));
      // The bias is `restitution` times the relative velocity before the step. The step therefore reverses this
      // fraction of the relative velocity.
      contacts.back().bias[0] = restitution * (k == 0 ? -kVelocity : 0.0);
    }
    GaussSeidel<3> solver(bodies, contacts);
    ASSERT_TRUE(solver.solve(kTolerance, 10'000).converged);
    EXPECT_NEAR(bodies.velocity[0][0], ((1.0 + restitution) / kBalls - restitution) * kVelocity, 1e-12);
    for (int k = 1; k < kBalls; ++k) {
      EXPECT_NEAR(bodies.velocity[k][0], (1.0 + restitution) * kVelocity / kBalls, 1e-12);
      EXPECT_NEAR(contacts[k - 1].impulse[0], (kBalls - k) * (1.0 + restitution) * kMass * kVelocity / kBalls,
                  1e-12);
    }
  }
}

/// Block of width w, height h and weight w h on a slope, in coordinates along and across the slope. Its two contact
/// points are the lower and the upper end of its base.
struct BlockOnSlope {
  double width, height, slope, friction;
  double step = 0.005;

  std::vector<StepContact<2>> contacts() const {
    std::vector<StepContact<2>> out;
    for (const double side : {1.0, -1.0}) {
      const Vec<2> arm(side * width / 2, -height / 2);
      out.push_back(touching<2>(0, 1, arm, arm, {0.0, -1.0}, friction));
    }
    return out;
  }
  BodyMotion<2> bodies() const {
    const double mass = width * height;
    BodyMotion<2> out =
        bodies_and_ground<2>(1, mass, Mat<1>::Constant(mass * (width * width + height * height) / 12.0));
    const double angle = std::atan(slope);
    out.velocity[0] = step * Vec<2>(std::sin(angle), -std::cos(angle));
    return out;
  }
};

/// Results of the first step: acceleration along the slope, normal forces at the lower and the upper contact point, and
/// angular velocity.
struct FirstStep {
  double acceleration, lower, upper, spin;
};

FirstStep first_step(const BlockOnSlope& block) {
  BodyMotion<2> bodies = block.bodies();
  std::vector<StepContact<2>> contacts = block.contacts();
  EXPECT_TRUE(GaussSeidel<2>(bodies, contacts).solve(kTolerance, 100'000).converged);
  return {bodies.velocity[0][0] / block.step, contacts[0].impulse[0] / block.step,
          contacts[1].impulse[0] / block.step, bodies.angular_velocity[0][0]};
}

TEST(GaussSeidel, ABlockOnASlopeRestsOnPointsOfTheClosedForm) {
  const FirstStep square = first_step({.width = 1.0, .height = 1.0, .slope = 0.45, .friction = 0.5});
  EXPECT_NEAR(square.lower, 0.66114309, 1e-8);
  EXPECT_NEAR(square.upper, 0.25077841, 1e-8);
  EXPECT_LT(std::abs(square.acceleration), 1e-10);
  const FirstStep tall = first_step({.width = 1.0, .height = 2.0, .slope = 0.45, .friction = 0.7});
  EXPECT_NEAR(tall.lower, 1.73265086, 1e-8);
  EXPECT_NEAR(tall.upper, 0.09119215, 1e-8);
  EXPECT_LT(std::abs(tall.acceleration), 1e-10);
}

TEST(GaussSeidel, ASteepBlockSlides) {
  const FirstStep square = first_step({.width = 1.0, .height = 1.0, .slope = 0.55, .friction = 0.5});
  EXPECT_NEAR(square.acceleration, 0.04381080, 1e-8);
  EXPECT_NEAR(square.lower, 0.65716193, 1e-8);
  EXPECT_NEAR(square.upper, 0.21905398, 1e-8);
  EXPECT_NEAR(first_step({.width = 1.0, .height = 2.0, .slope = 0.45, .friction = 0.4}).acceleration,
              0.04559608, 1e-8);
}

TEST(GaussSeidel, ATallBlockTipsOverItsLowerEdge) {
  const FirstStep tall = first_step({.width = 1.0, .height = 2.0, .slope = 0.55, .friction = 0.7});
  EXPECT_NEAR(tall.lower, 1.778718, 1e-6);
  EXPECT_EQ(tall.upper, 0.0);
  EXPECT_LT(tall.spin, 0.0);
}

template <int Dim>
double acceleration_on_slope(double slope, double friction) {
  constexpr double kStep = 0.01;
  BodyMotion<Dim> bodies = balls_and_ground<Dim>(1, 1.0, 0.5);
  const double angle = std::atan(slope);
  bodies.velocity[0] = kStep * (std::sin(angle) * Vec<Dim>::Unit(0) - std::cos(angle) * Vec<Dim>::Unit(1));
  const Vec<Dim> down = -Vec<Dim>::Unit(1);
  std::vector<StepContact<Dim>> contacts{touching<Dim>(0, 1, 0.5 * down, 0.5 * down, down, friction)};
  EXPECT_TRUE(GaussSeidel<Dim>(bodies, contacts).solve(kTolerance, 1000).converged);
  return bodies.velocity[0][0] / (kStep * std::sin(angle));
}

TEST(GaussSeidel, RoundGrainsRollDownASlopeUntilItIsTooSteep) {
  EXPECT_NEAR(acceleration_on_slope<2>(0.29, 0.1), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(acceleration_on_slope<3>(0.34, 0.1), 5.0 / 7.0, 1e-12);
  // A disk slides if tan a > 3 mu, and a sphere if tan a > 7/2 mu. The acceleration is then g (sin a - mu cos a).
  EXPECT_NEAR(acceleration_on_slope<2>(0.5, 0.1), 0.8, 1e-12);
  EXPECT_NEAR(acceleration_on_slope<3>(0.5, 0.1), 0.8, 1e-12);
}

// The two contacts have equal normal forces N and friction forces T. With the angle b of the sides and the weight 1,
// the only condition of balance is 2 (N cos b + T sin b) = 1. The forces are therefore not unique: any T with |T| <= mu
// N is possible.
TEST(GaussSeidel, ADiskInAGrooveRestsOnForcesWithinTheLimitOfFriction) {
  constexpr double kAngle = std::numbers::pi / 3.0, kFriction = 0.3, kStep = 0.01;
  BodyMotion<2> bodies = balls_and_ground<2>(1, 1.0, 1.0);
  bodies.velocity[0] = {0.0, -kStep};
  std::vector<StepContact<2>> contacts;
  for (const double side : {1.0, -1.0}) {
    const Vec<2> normal(side * std::sin(kAngle), -std::cos(kAngle));
    contacts.push_back(touching<2>(0, 1, normal, normal, normal, kFriction));
  }
  ASSERT_TRUE(GaussSeidel<2>(bodies, contacts).solve(kTolerance, 100'000).converged);
  for (const StepContact<2>& c : contacts) {
    const double normal = c.impulse[0] / kStep, tangential = std::abs(c.impulse[1]) / kStep;
    EXPECT_NEAR(2.0 * (normal * std::cos(kAngle) + tangential * std::sin(kAngle)), 1.0, 1e-10);
    EXPECT_LE(tangential, kFriction * normal * (1.0 + 1e-10));
    EXPECT_GT(tangential, 0.9 * kFriction * normal);
  }
}

/// Returns the corners of a rectangle in the plane z = height.
std::vector<Vec<3>> corners(double x_low, double x_high, double y_half, double height) {
  return {
      {x_low, -y_half, height}, {x_high, -y_half, height}, {x_low, y_half, height}, {x_high, y_half, height}};
}

TEST(GaussSeidel, ASpinningCubeIsSlowedByFriction) {
  constexpr double kFriction = 0.3, kGravity = 1.0, kStep = 0.001, kSpin = 0.9;
  BodyMotion<3> bodies = bodies_and_ground<3>(1, 1.0, Mat<3>::Identity() / 6.0);
  bodies.velocity[0] = {0.0, 0.0, -kStep * kGravity};
  bodies.angular_velocity[0] = {0.0, 0.0, kSpin};
  std::vector<StepContact<3>> contacts;
  for (const Vec<3>& arm : corners(-0.5, 0.5, 0.5, -0.5))
    contacts.push_back(touching<3>(0, 1, arm, arm, {0.0, 0.0, -1.0}, kFriction));
  ASSERT_TRUE(GaussSeidel<3>(bodies, contacts).solve(kTolerance, 100'000).converged);
  // The spin w0 stops after the time w0 sqrt(2)/(6 mu g).
  const double slowing = 6.0 * kFriction * kGravity / std::numbers::sqrt2;
  EXPECT_NEAR(bodies.angular_velocity[0][2], kSpin - slowing * kStep, 1e-12);
  EXPECT_LT(bodies.velocity[0].norm(), 1e-12);
}

TEST(GaussSeidel, CarriesALeaningColumnOfCubes) {
  constexpr int kCubes = 10;
  constexpr double kShift = 0.04, kStep = 0.01;
  BodyMotion<3> bodies = bodies_and_ground<3>(kCubes, 1.0, Mat<3>::Identity() / 6.0);
  std::vector<StepContact<3>> contacts;
  // Cube k has its centre at (k shift, 0, k + 1/2); cube 0 stands on the ground.
  for (int k = 0; k < kCubes; ++k) {
    bodies.velocity[k] = {0.0, 0.0, -kStep};
    const Vec<3> centre(k * kShift, 0.0, k + 0.5), below = centre - Vec<3>(kShift, 0.0, 1.0);
    for (const Vec<3>& point : corners(centre[0] - 0.5, (k == 0 ? centre : below)[0] + 0.5, 0.5, k))
      contacts.push_back(
          touching<3>(k, k == 0 ? kCubes : k - 1, point - centre, point - below, {0.0, 0.0, -1.0}, 0.5));
  }
  ASSERT_TRUE(GaussSeidel<3>(bodies, contacts).solve(1e-11, 400'000, 100).converged);
  for (int k = 0; k < kCubes; ++k) {
    double force = 0.0, moment = 0.0;
    for (int n = 4 * k; n < 4 * k + 4; ++n) {
      force += contacts[n].impulse[0] / kStep;
      moment += contacts[n].impulse[0] / kStep * (contacts[n].arm_i[0] + k * kShift);
    }
    EXPECT_NEAR(force, kCubes - k, 1e-8);
    EXPECT_NEAR(moment / force, 0.5 * (k + kCubes - 1) * kShift, 1e-7) << "centre of mass of what is above";
  }
}

TEST(GaussSeidel, AnAdhesivePairPartsAboveItsAdhesion) {
  for (const double pull : {0.9, 1.1}) {
    BodyMotion<2> bodies = balls_and_ground<2>(1, 2.0, 0.5);
    bodies.velocity[0] = {0.0, pull / 2.0};
    std::vector<StepContact<2>> contacts{touching<2>(0, 1, {0.0, -0.5}, {0.0, -0.5}, {0.0, -1.0}, 0.0)};
    contacts[0].adhesion = 1.0;
    ASSERT_TRUE(GaussSeidel<2>(bodies, contacts).solve(kTolerance, 100).converged);
    EXPECT_NEAR(contacts[0].impulse[0], std::max(0.0, 1.0 - pull), 1e-14);
    EXPECT_NEAR(bodies.velocity[0][1], std::max(0.0, (pull - 1.0) / 2.0), 1e-14);
  }
}

TEST(GaussSeidel, ContactsOfOneColourShareNoBodyThatMoves) {
  BodyMotion<2> bodies = balls_and_ground<2>(4, 1.0, 0.5);
  std::vector<StepContact<2>> contacts;
  // Four disks form a ring on the ground, and each disk also touches the ground. Contacts of one colour must not share
  // a disk. The contacts of the ring therefore need two colours, and the contacts with the ground a third colour.
  for (int k = 0; k < 4; ++k)
    contacts.push_back(touching<2>(k, (k + 1) % 4, {0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, 0.0));
  for (int k = 0; k < 4; ++k) contacts.push_back(touching<2>(k, 4, {0.0, 0.0}, {0.0, 0.0}, {0.0, -1.0}, 0.0));
  EXPECT_EQ(GaussSeidel<2>(bodies, contacts).n_colours(), 3);
}

}  // namespace
}  // namespace floc::test
