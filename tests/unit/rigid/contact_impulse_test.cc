#include "floc/rigid/contact_impulse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace floc::test {
namespace {

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
