#include "floc/rigid/coupled_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "floc/rigid/contact_impulse.h"
#include "floc/rigid/gauss_seidel.h"
#include "support/step_contacts.h"

namespace floc::test {
namespace {

constexpr int kProblems = 10'000;

/// Returns the friction coefficient of a problem. The coefficients repeat periodically.
double friction_of(int n) {
  constexpr double kFrictions[] = {0.5, 0.0, 0.1, 1.5, 10.0};
  return kFrictions[n % 5];
}

/// Random problems of a single contact. In every second problem, slip and normal motion are coupled almost as strongly
/// as a positive definite response allows. With a large friction coefficient, the contact then acts like a steep wedge.
template <int Dim>
class Problems {
 public:
  ContactProblem<Dim> next(int n) {
    const auto noise = [&] { return normal_(engine_); };
    ContactProblem<Dim> out;
    out.response = Vec<Dim>::NullaryExpr([&] { return 0.5 + std::abs(noise()); }).asDiagonal();
    const double coupling = n % 2 == 0 ? 0.2 : 0.95 / std::sqrt(Dim - 1.0);
    for (int a = 1; a < Dim; ++a)
      out.response(0, a) = out.response(a, 0) =
          (noise() > 0.0 ? 1.0 : -1.0) * coupling * std::sqrt(out.response(0, 0) * out.response(a, a));
    out.velocity = Vec<Dim>::NullaryExpr(noise);
    out.friction = friction_of(n);
    return out;
  }

 private:
  std::mt19937 engine_{Dim};
  std::normal_distribution<double> normal_;
};

template <int Dim>
void expect_the_impulses_of_the_reference() {
  Problems<Dim> problems;
  int n_stick = 0, n_slide = 0, n_other = 0;
  for (int n = 0; n < kProblems; ++n) {
    const ContactProblem<Dim> problem = problems.next(n);
    CoupledResponse<Dim> response(problem.response, problem.friction);
    const Vec<Dim> expected = contact_impulse(problem), found = response.impulse(problem.velocity);
    EXPECT_LT(contact_error(problem, found), 1e-13 * (1.0 + found.norm())) << "problem " << n;
    n_other += !((found - expected).norm() <= 1e-12 * expected.norm());
    const double limit = problem.friction * expected[0];
    const double size = expected.template tail<Dim - 1>().norm();
    n_stick += expected[0] > 0.0 && size < 0.999999 * limit;
    n_slide += expected[0] > 0.0 && size >= 0.999999 * limit;
  }
  // In 3D a steep wedge may have several solutions, and the two functions may find different ones.
  EXPECT_LE(n_other, Dim == 2 ? 0 : 2);
  EXPECT_GT(n_stick, kProblems / 20);
  EXPECT_GT(n_slide, kProblems / 20);
}

TEST(CoupledResponse, SolvesProblemsInThePlane) {
  expect_the_impulses_of_the_reference<2>();
}

TEST(CoupledResponse, SolvesProblemsInSpace) {
  expect_the_impulses_of_the_reference<3>();
}

/// Returns the relative velocity at a contact.
template <int Dim>
Vec<Dim> relative_velocity(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c) {
  Vec<Dim> u = bodies.velocity[c.j] + cross<double>(bodies.angular_velocity[c.j], c.arm_j);
  u -= bodies.velocity[c.i] + cross<double>(bodies.angular_velocity[c.i], c.arm_i);
  return c.frame.transpose() * (u + bodies.stretch.cwiseProduct(c.branch));
}

/// Returns the velocities after an impulse acts on body j and the opposite impulse acts on body i.
template <int Dim>
BodyMotion<Dim> after(BodyMotion<Dim> bodies, const StepContact<Dim>& c, const Vec<Dim>& impulse) {
  const Vec<Dim> in_space = c.frame * impulse;
  bodies.velocity[c.j] += bodies.inverse_mass[c.j].cwiseProduct(in_space);
  bodies.velocity[c.i] -= bodies.inverse_mass[c.i].cwiseProduct(in_space);
  bodies.angular_velocity[c.j] += bodies.inverse_inertia[c.j] * moment<double>(c.arm_j, in_space);
  bodies.angular_velocity[c.i] -= bodies.inverse_inertia[c.i] * moment<double>(c.arm_i, in_space);
  bodies.stretch += bodies.inverse_stretch_mass.cwiseProduct(c.branch.cwiseProduct(in_space));
  return bodies;
}

/// Returns the problem of a contact. The response to an impulse is computed with unit impulses.
template <int Dim>
ContactProblem<Dim> problem_of(const BodyMotion<Dim>& bodies, const StepContact<Dim>& c) {
  ContactProblem<Dim> out;
  const Vec<Dim> free = relative_velocity(bodies, c);
  for (int a = 0; a < Dim; ++a) {
    out.response.col(a) = relative_velocity(after<Dim>(bodies, c, Vec<Dim>::Unit(a)), c) - free;
    out.response(a, a) += a == 0 ? c.normal_compliance : c.tangential_compliance;
  }
  out.velocity = free + c.bias;
  out.friction = c.friction;
  return out;
}

/// Two random bodies in contact. Bodies that are not round are in a cell under stress.
template <int Dim>
class Pairs {
 public:
  explicit Pairs(bool round) : round_(round) {}

  BodyMotion<Dim> bodies() {
    BodyMotion<Dim> out;
    for (int i = 0; i < 2; ++i) {
      out.velocity.push_back(vector<Dim>());
      out.angular_velocity.push_back(vector<kRotations<Dim>>());
      out.inverse_mass.push_back(Vec<Dim>::Constant(positive()));
      Mat<kRotations<Dim>> inertia = positive() * Mat<kRotations<Dim>>::Identity();
      if (!round_) {
        const Mat<kRotations<Dim>> root = Mat<kRotations<Dim>>::NullaryExpr([&] { return normal_(engine_); });
        inertia += root * root.transpose();
      }
      out.inverse_inertia.push_back(inertia);
    }
    out.stretch = vector<Dim>();
    if (!round_) out.inverse_stretch_mass = vector<Dim>().cwiseAbs2();
    return out;
  }
  StepContact<Dim> contact(int n) {
    const Vec<Dim> normal = vector<Dim>().normalized();
    StepContact<Dim> out =
        touching<Dim>(0, 1, positive() * normal, -positive() * normal, normal, friction_of(n));
    if (!round_) {
      out.arm_i += vector<Dim>();
      out.arm_j += vector<Dim>();
    }
    out.branch = out.arm_i - out.arm_j;
    out.bias = vector<Dim>();
    // Some frames of tangent vectors are left-handed.
    if (n % 3 == 0) out.frame.col(1) *= -1.0;
    if (n % 2 == 0) out.normal_compliance = positive();
    if (n % 4 == 0) out.tangential_compliance = positive();
    return out;
  }

 private:
  template <int n>
  Vec<n> vector() {
    return Vec<n>::NullaryExpr([&] { return normal_(engine_); });
  }
  double positive() { return 0.2 + std::abs(normal_(engine_)); }

  bool round_;
  std::mt19937 engine_{3};
  std::normal_distribution<double> normal_;
};

template <int Dim>
void expect_one_sweep_to_solve_a_pair(bool round) {
  Pairs<Dim> pairs(round);
  for (int n = 0; n < kProblems / 4; ++n) {
    BodyMotion<Dim> bodies = pairs.bodies();
    std::vector<StepContact<Dim>> contacts{pairs.contact(n)};
    const BodyMotion<Dim> before = bodies;
    const ContactProblem<Dim> problem = problem_of(bodies, contacts[0]);
    const SweepResult result = GaussSeidel<Dim>(bodies, contacts).solve(0.0, 1);
    const Vec<Dim> expected = contact_impulse(problem);
    // Velocities are of order 1, and responses (velocity per impulse) are at least 0.4. The impulses are therefore also
    // of order 1, with rounding errors far below the tolerance.
    EXPECT_LT((contacts[0].impulse - expected).norm(), 1e-12 * expected.norm() + 1e-300) << "pair " << n;
    EXPECT_LT(result.residual, 1e-12) << "pair " << n;
    const BodyMotion<Dim> moved = after(before, contacts[0], expected);
    for (int i = 0; i < 2; ++i) {
      EXPECT_LT((bodies.velocity[i] - moved.velocity[i]).norm(), 1e-11) << "pair " << n;
      EXPECT_LT((bodies.angular_velocity[i] - moved.angular_velocity[i]).norm(), 1e-11) << "pair " << n;
    }
    EXPECT_LT((bodies.stretch - moved.stretch).norm(), 1e-11) << "pair " << n;
  }
}

TEST(GaussSeidel, OneSweepSolvesAPairOfRoundGrains) {
  expect_one_sweep_to_solve_a_pair<2>(true);
  expect_one_sweep_to_solve_a_pair<3>(true);
}

TEST(GaussSeidel, OneSweepSolvesAPairOfAngularGrainsInACellUnderStress) {
  expect_one_sweep_to_solve_a_pair<2>(false);
  expect_one_sweep_to_solve_a_pair<3>(false);
}

}  // namespace
}  // namespace floc::test
