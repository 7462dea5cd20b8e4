#include "floc/rigid/interior_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "floc/rigid/second_order_cone.h"

namespace floc::test {
namespace {

/// Disk of radius 1 in a groove whose sides are inclined by `angle` to the horizontal, under a load (0, -W). Each of
/// the two contacts is a block (P, T/mu) of the cone program, with the normal force P and the tangential force T. The
/// rows of the program are the balance of forces along x and y and of moments.
struct Groove {
  double angle = std::numbers::pi / 3.0;
  double friction = 0.3;
  double load = 1.0;
  double kn = 1.0, kt = 1.0;

  ConeProgram<2> program() const {
    ConeProgram<2> out;
    for (const double side : {1.0, -1.0}) {
      const Vec<2> normal(side * std::sin(angle), std::cos(angle)), tangent(-normal[1], normal[0]);
      for (int a = 0; a < 2; ++a) {
        out.row.push_back(a);
        out.coefficient.emplace_back(normal[a], friction * tangent[a]);
      }
      out.row.push_back(2);
      out.coefficient.emplace_back(0.0, -friction);
      out.first.push_back(static_cast<int>(out.row.size()));
      out.compliance.emplace_back(1.0 / kn, friction * friction / kt);
      out.linear.emplace_back(0.0, 0.0);
    }
    out.group = {0, 0, 0};
    out.load = Eigen::Vector3d(0.0, load, 0.0);
    return out;
  }
  /// Normal force of each contact if the friction has its largest possible value and acts upwards (direction = 1) or
  /// downwards (-1).
  double mobilised_force(double direction) const {
    return load / (2.0 * (std::cos(angle) + direction * friction * std::sin(angle)));
  }
};

ConeSolution<2> extreme_force(const Groove& groove, double sign) {
  ConeProgram<2> program = groove.program();
  program.linear[0][0] = -sign;
  return InteriorPoint<2>(program).minimise_linear(program, -1e9);
}

TEST(InteriorPoint, FindsTheRangeOfForcesInAGroove) {
  const Groove groove;
  const ConeSolution<2> smallest = extreme_force(groove, -1.0), largest = extreme_force(groove, 1.0);
  ASSERT_EQ(smallest.status, ConeStatus::kSolved);
  ASSERT_EQ(largest.status, ConeStatus::kSolved);
  EXPECT_NEAR(smallest.x[0][0], 0.65806131, 1e-8);
  EXPECT_NEAR(smallest.x[0][0], groove.mobilised_force(1.0), 1e-9);
  EXPECT_NEAR(largest.x[0][0], 2.08166472, 1e-8);
  EXPECT_NEAR(largest.x[0][0], groove.mobilised_force(-1.0), 1e-9);
}

TEST(InteriorPoint, ProvesThatADiskCanBeWedgedWithoutBound) {
  const ConeSolution<2> largest = extreme_force({.friction = 1.0}, 1.0);
  EXPECT_EQ(largest.status, ConeStatus::kUnbounded);
}

TEST(InteriorPoint, LeastEnergyInAGrooveIsThatOfSprings) {
  // The disk moves down. Its motion gives the spring forces P and T the ratio T/P = (K_T/K_N) tan b.
  const Groove groove{.friction = 1.0, .kn = 2.0, .kt = 1.0};
  const ConeProgram<2> program = groove.program();
  const ConeSolution<2> found = InteriorPoint<2>(program).solve(program);
  ASSERT_EQ(found.status, ConeStatus::kSolved);
  for (const Vec<2>& x : found.x)
    EXPECT_NEAR(std::abs(groove.friction * x[1]) / x[0], 0.5 * std::tan(groove.angle), 1e-10);
}

TEST(InteriorPoint, ProvesThatNoForceHoldsADiskThatIsPulledOut) {
  const ConeProgram<2> program = Groove{.load = -1.0}.program();
  const ConeSolution<2> found = InteriorPoint<2>(program).solve(program);
  ASSERT_EQ(found.status, ConeStatus::kInfeasible);
  // The program returns a motion that opens the contacts and on which the load does positive work. Such a motion proves
  // that no contact forces can balance the load.
  EXPECT_GT(program.load.dot(found.motion), 0.0);
  for (int k = 0; k < program.n_blocks(); ++k) {
    Vec<2> opening = Vec<2>::Zero();
    for (int e = program.first[k]; e < program.first[k + 1]; ++e)
      opening -= program.coefficient[e] * found.motion[program.row[e]];
    EXPECT_GT(cone::margin<2>(opening), -1e-8 * found.motion.norm());
  }
}

/// Returns a program with random coefficients. The program is feasible: its load is A x, where x is a random vector in
/// the cones.
template <int Dim>
ConeProgram<Dim> random_program(unsigned seed) {
  constexpr int kBlocks = 12, kRows = 8;
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  ConeProgram<Dim> out;
  out.load = Eigen::VectorXd::Zero(kRows);
  for (int r = 0; r < kRows; ++r) out.group.push_back(r);
  for (int k = 0; k < kBlocks; ++k) {
    // One of three blocks of x is zero, one is on the surface of its cone, and one is inside its cone.
    Vec<Dim> x = Vec<Dim>::NullaryExpr([&] { return uniform(engine); });
    x[0] = x.template tail<Dim - 1>().norm() + (k % 3 == 0 ? 1.0 : 0.0);
    if (k % 3 == 1) x.setZero();
    for (int r = 0; r < kRows; ++r) {
      out.row.push_back(r);
      out.coefficient.push_back(Vec<Dim>::NullaryExpr([&] { return uniform(engine); }));
      out.load[r] += out.coefficient.back().dot(x);
    }
    out.first.push_back(static_cast<int>(out.row.size()));
    out.compliance.push_back(Vec<Dim>::Constant(1.0 + 0.5 * uniform(engine)));
    // The cost vector is inside the cone, so that the objective is bounded.
    out.linear.push_back(Vec<Dim>::NullaryExpr([&] { return 0.3 * uniform(engine); }) + Vec<Dim>::Unit(0));
  }
  return out;
}

/// Expects the optimality conditions: A x = b; x and z = Q x + c - A' y are in the cones; x' z = 0.
template <int Dim>
void expect_optimal(const ConeProgram<Dim>& program, const ConeSolution<Dim>& found, double tolerance) {
  ASSERT_EQ(found.status, ConeStatus::kSolved);
  Eigen::VectorXd balance = -program.load;
  for (int k = 0; k < program.n_blocks(); ++k) {
    Vec<Dim> z = program.compliance[k].cwiseProduct(found.x[k]) + program.linear[k];
    for (int e = program.first[k]; e < program.first[k + 1]; ++e) {
      z -= program.coefficient[e] * found.motion[program.row[e]];
      balance[program.row[e]] += program.coefficient[e].dot(found.x[k]);
    }
    EXPECT_GT(cone::margin<Dim>(found.x[k]), -tolerance);
    EXPECT_GT(cone::margin<Dim>(z), -tolerance);
    EXPECT_NEAR(found.x[k].dot(z), 0.0, tolerance);
  }
  EXPECT_LT(balance.cwiseAbs().maxCoeff(), tolerance);
}

TEST(InteriorPoint, SolutionsSatisfyTheConditionsOfOptimality) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const ConeProgram<2> disks = random_program<2>(seed);
    expect_optimal<2>(disks, InteriorPoint<2>(disks).solve(disks), 1e-10);
    const ConeProgram<3> spheres = random_program<3>(seed);
    expect_optimal<3>(spheres, InteriorPoint<3>(spheres).solve(spheres), 1e-10);
  }
}

/// Returns n random programs that share no rows, as one program.
template <int Dim>
ConeProgram<Dim> joined_programs(unsigned n) {
  ConeProgram<Dim> out;
  std::vector<double> load;
  for (unsigned seed = 1; seed <= n; ++seed) {
    const ConeProgram<Dim> part = random_program<Dim>(seed);
    const int rows = static_cast<int>(load.size()), entries = static_cast<int>(out.row.size());
    for (const int row : part.row) out.row.push_back(rows + row);
    for (const int group : part.group) out.group.push_back(rows + group);
    for (int k = 1; k <= part.n_blocks(); ++k) out.first.push_back(entries + part.first[k]);
    out.coefficient.insert(out.coefficient.end(), part.coefficient.begin(), part.coefficient.end());
    out.compliance.insert(out.compliance.end(), part.compliance.begin(), part.compliance.end());
    out.linear.insert(out.linear.end(), part.linear.begin(), part.linear.end());
    load.insert(load.end(), part.load.begin(), part.load.end());
  }
  out.load = Eigen::Map<const Eigen::VectorXd>(load.data(), static_cast<Eigen::Index>(load.size()));
  return out;
}

template <int Dim>
void expect_parts_as_if_alone(unsigned n) {
  const ConeProgram<Dim> program = joined_programs<Dim>(n);
  InteriorPoint<Dim> method(program);
  ConeSolution<Dim> found = method.solve(program);
  ASSERT_EQ(found.status, ConeStatus::kSolved);
  method.polish(program, found);
  std::size_t at = 0;
  for (unsigned seed = 1; seed <= n; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const ConeProgram<Dim> part = random_program<Dim>(seed);
    for (const Vec<Dim>& x : InteriorPoint<Dim>(part).solve(part).x)
      EXPECT_LT((found.x[at++] - x).norm(), 1e-6);
  }
}

TEST(InteriorPoint, ProgramsOfManyBlocksHaveTheSolutionsOfTheirParts) {
  // 8400 blocks: additional directions follow each factorization.
  expect_parts_as_if_alone<2>(700);
  expect_parts_as_if_alone<3>(700);
}

TEST(InteriorPoint, NoFeasibleDirectionLowersALinearMinimum) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const ConeProgram<2> program = random_program<2>(seed);
    const ConeSolution<2> minimum = InteriorPoint<2>(program).minimise_linear(program, -1e9);
    ASSERT_EQ(minimum.status, ConeStatus::kSolved);
    // At the last proximal point, the gradient of the proximal term is zero. The multipliers therefore also solve the
    // linear program.
    ConeProgram<2> linear = program;
    linear.compliance.assign(program.n_blocks(), Vec<2>::Zero());
    expect_optimal<2>(linear, minimum, 1e-6);
  }
}

TEST(SecondOrderCone, ScalingMapsThePairToOnePoint) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double margin : {1.0, 1e-4, 1e-8}) {
    const auto inside = [&] {
      Vec<3> x(0.0, uniform(engine), uniform(engine));
      x[0] = x.norm() + margin;
      return x;
    };
    const Vec<3> x = inside(), z = inside();
    const cone::Scaling<3> scaling(x, z);
    // The vectors x and z are inside the cone, but only about `margin` away from its surface. The scaling multiplies
    // their rounding errors by 1/margin.
    EXPECT_LT((scaling.scaled(z) - scaling.unscaled(x)).norm(), 1e-14 / margin);
    EXPECT_LT((scaling.unscaled(scaling.scaled(z)) - z).norm(), 1e-14 / margin);
  }
}

TEST(SecondOrderCone, SquareHasTheSquaresOfTheEigenvalues) {
  const Vec<3> a(2.0, 0.5, -1.0);
  const auto square = [](double e) { return e * e; };
  EXPECT_LT((cone::of_eigenvalues<3>(a, square) - cone::product<3>(a, a)).norm(), 1e-15);
  EXPECT_LT((cone::of_eigenvalues<3>(Vec<3>::Unit(0), square) - Vec<3>::Unit(0)).norm(), 1e-15);
}

TEST(SecondOrderCone, QuotientUndoesTheProduct) {
  const Vec<3> a(2.0, 0.5, -1.0), b(0.3, -0.7, 0.2);
  EXPECT_LT((cone::quotient<3>(a, cone::product<3>(a, b)) - b).norm(), 1e-15);
}

TEST(SecondOrderCone, LongestStepEndsOnTheSurface) {
  const Vec<3> x(2.0, 0.5, -1.0), dx(-1.0, 2.0, 0.3);
  const double step = cone::longest_step<3>(x, dx);
  EXPECT_NEAR(cone::margin<3>(x + step * dx), 0.0, 1e-15);
  EXPECT_TRUE(std::isinf(cone::longest_step<3>(x, Vec<3>(1.0, 0.5, 0.5))));
}

}  // namespace
}  // namespace floc::test
