#include "floc/rigid/gauss_seidel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc::test {
namespace {

constexpr double kTolerance = 1e-13;

/// Bodies at rest. The last one is fixed.
template <int Dim>
BodyMotion<Dim> bodies_and_ground(int n, double mass, const Mat<kRotations<Dim>>& inertia) {
  BodyMotion<Dim> out;
  out.velocity.assign(n + 1, Vec<Dim>::Zero());
  out.angular_velocity.assign(n + 1, RotationVector<Dim>::Zero());
  out.inverse_mass.assign(n + 1, 1.0 / mass);
  out.inverse_mass.back() = 0.0;
  out.inverse_inertia.assign(n + 1, inertia.inverse());
  out.inverse_inertia.back().setZero();
  return out;
}

template <int Dim>
BodyMotion<Dim> balls_and_ground(int n, double mass, double radius) {
  return bodies_and_ground<Dim>(
      n, mass, (Dim == 2 ? 0.5 : 0.4) * mass * radius * radius * Mat<kRotations<Dim>>::Identity());
}

template <int Dim>
StepContact<Dim> touching(int i, int j, const Vec<Dim>& arm_i, const Vec<Dim>& arm_j, const Vec<Dim>& normal,
                          double friction) {
  StepContact<Dim> out{};
  out.i = i;
  out.j = j;
  out.arm_i = arm_i;
  out.arm_j = arm_j;
  out.frame = contact_frame(normal);
  out.friction = friction;
  return out;
}

TEST(GaussSeidel, CarriesAStackOfDisksInTheFirstStep) {
  constexpr int kDisks = 20;
  constexpr double kMass = 2.0, kGravity = 3.0, kStep = 0.1;
  BodyMotion<2> bodies = balls_and_ground<2>(kDisks, kMass, 0.5);
  std::vector<StepContact<2>> contacts;
  // Disk 0 is the top one.
  for (int k = 0; k < kDisks; ++k) {
    contacts.push_back(touching<2>(k, k + 1, {0.0, -0.5}, {0.0, 0.5}, {0.0, -1.0}, 0.0));
    bodies.velocity[k] = {0.0, -kStep * kGravity};
  }
  GaussSeidel<2> solver(bodies, contacts);
  EXPECT_TRUE(solver.solve(kTolerance, 10'000).converged);
  for (int k = 0; k < kDisks; ++k)
    EXPECT_NEAR(contacts[k].impulse[0] / kStep, (k + 1) * kMass * kGravity, 1e-8);
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
      // The relative velocity of approach before the step.
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

/// A block of width w and height h with weight 1 on a slope, in axes along and across the slope, with the lower and the
/// upper point of its base.
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
    BodyMotion<2> out =
        bodies_and_ground<2>(1, 1.0, Mat<1>::Constant((width * width + height * height) / 12.0));
    const double angle = std::atan(slope);
    out.velocity[0] = step * Vec<2>(std::sin(angle), -std::cos(angle));
    return out;
  }
};

TEST(GaussSeidel, ABlockOnASlopeRestsOnPointsOfTheClosedForm) {
  const BlockOnSlope block{.width = 1.0, .height = 1.0, .slope = 0.45, .friction = 0.5};
  BodyMotion<2> bodies = block.bodies();
  std::vector<StepContact<2>> contacts = block.contacts();
  ASSERT_TRUE(GaussSeidel<2>(bodies, contacts).solve(kTolerance, 100'000).converged);
  EXPECT_NEAR(contacts[0].impulse[0] / block.step, 0.66114309, 1e-8);
  EXPECT_NEAR(contacts[1].impulse[0] / block.step, 0.25077841, 1e-8);
  EXPECT_LT(bodies.velocity[0].norm(), 1e-12);
}

TEST(GaussSeidel, ASteepBlockSlides) {
  const BlockOnSlope block{.width = 1.0, .height = 1.0, .slope = 0.55, .friction = 0.5};
  BodyMotion<2> bodies = block.bodies();
  std::vector<StepContact<2>> contacts = block.contacts();
  ASSERT_TRUE(GaussSeidel<2>(bodies, contacts).solve(kTolerance, 100'000).converged);
  EXPECT_NEAR(bodies.velocity[0][0] / block.step, 0.04381080, 1e-8);
  EXPECT_NEAR(contacts[0].impulse[0] / block.step, 0.65716193, 1e-8);
  EXPECT_NEAR(contacts[1].impulse[0] / block.step, 0.21905398, 1e-8);
}

TEST(GaussSeidel, ATallBlockTipsOverItsLowerEdge) {
  const BlockOnSlope block{.width = 0.5, .height = 1.0, .slope = 0.55, .friction = 0.7};
  BodyMotion<2> bodies = block.bodies();
  std::vector<StepContact<2>> contacts = block.contacts();
  ASSERT_TRUE(GaussSeidel<2>(bodies, contacts).solve(kTolerance, 100'000).converged);
  EXPECT_EQ(contacts[1].impulse[0], 0.0);
  EXPECT_LT(bodies.angular_velocity[0][0], 0.0);
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
  // Beyond 3 mu and 7/2 mu they slide: g (sin a - mu cos a).
  EXPECT_NEAR(acceleration_on_slope<2>(0.5, 0.1), 0.8, 1e-12);
  EXPECT_NEAR(acceleration_on_slope<3>(0.5, 0.1), 0.8, 1e-12);
}

TEST(GaussSeidel, ADiskInAGrooveEndsOnTheLimitOfFriction) {
  constexpr double kAngle = std::numbers::pi / 3.0, kFriction = 0.3, kStep = 0.01;
  BodyMotion<2> bodies = balls_and_ground<2>(1, 1.0, 1.0);
  bodies.velocity[0] = {0.0, -kStep};
  std::vector<StepContact<2>> contacts;
  for (const double side : {1.0, -1.0}) {
    const Vec<2> normal(side * std::sin(kAngle), -std::cos(kAngle));
    contacts.push_back(touching<2>(0, 1, normal, normal, normal, kFriction));
  }
  ASSERT_TRUE(GaussSeidel<2>(bodies, contacts).solve(kTolerance, 100'000).converged);
  for (const StepContact<2>& c : contacts) EXPECT_NEAR(c.impulse[0] / kStep, 0.65806131, 1e-7);
}

TEST(GaussSeidel, ContactsOfOneColourShareNoBodyThatMoves) {
  BodyMotion<2> bodies = balls_and_ground<2>(4, 1.0, 0.5);
  std::vector<StepContact<2>> contacts;
  // A ring of four disks, each on the ground too: two colours of the ring, and one more.
  for (int k = 0; k < 4; ++k) contacts.push_back(touching<2>(k, (k + 1) % 4, {}, {}, {1.0, 0.0}, 0.0));
  for (int k = 0; k < 4; ++k) contacts.push_back(touching<2>(k, 4, {}, {}, {0.0, -1.0}, 0.0));
  EXPECT_EQ(GaussSeidel<2>(bodies, contacts).n_colours(), 3);
}

template <int Dim>
void expect_solutions(unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  for (int n = 0; n < 2000; ++n) {
    const Mat<Dim> root = Mat<Dim>::NullaryExpr([&] { return normal(engine); });
    ContactProblem<Dim> problem;
    problem.response = root * root.transpose() + 0.1 * Mat<Dim>::Identity();
    problem.velocity = Vec<Dim>::NullaryExpr([&] { return normal(engine); });
    problem.friction = 0.3 * std::abs(normal(engine));
    const Vec<Dim> impulse = contact_impulse(problem);
    EXPECT_LT(contact_error(problem, impulse), 1e-12 * (1.0 + impulse.norm())) << "problem " << n;
  }
}

TEST(ContactImpulse, SolvesRandomProblems) {
  expect_solutions<2>(1);
  expect_solutions<3>(2);
}

}  // namespace
}  // namespace floc::test
