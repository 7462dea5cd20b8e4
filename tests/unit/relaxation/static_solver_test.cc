#include "floc/relaxation/static_solver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "floc/elasticity/moduli.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/tile.h"
#include "floc/relaxation/relaxer.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/lattices.h"
#include "support/springs.h"

namespace floc {
namespace {

const Vec<2> kTarget(0.5, 0.5);

/// Returns an equilibrium of very soft grains, whose overlaps are a tenth of a diameter. In the tangent of such a
/// packing, the terms F/r (F: force, r: branch length) are as large as the stiffness terms.
Packing<2> soft_equilibrium() {
  Law law = test::cohesive_law();
  law += test::linear(10.0);
  law += test::tail_adhesion(1.0, 0.05);
  law += test::coulomb(0.5, 8.0);
  law += test::rolling_spring(0.05, 0.3);
  RelaxationOptions options;
  options.strain_rate_cap = 0.05;
  Relaxer<2> relaxer(options, test::gas_of(20, law, 0.5), kTarget);
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) status = relaxer.advance();
  EXPECT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
  return relaxer.packing();
}

/// Returns the soft equilibrium with one sliding contact and one contact at its rolling limit: the contacts that are
/// nearest to these limits. The springs of both contacts are stretched beyond their limits, so that the contacts slide
/// and roll under any displacement of the grains.
Packing<2> with_yielding_contacts(Packing<2> packing) {
  const auto mobilised = [](const Contact<2>& c) {
    return c.distant ? 0.0 : c.shear_force.norm() / c.elastic_force;
  };
  const auto rolled = [](const Contact<2>& c) {
    return c.distant ? 0.0 : c.rolling_moment.norm() / c.elastic_force;
  };
  auto& contacts = packing.contacts;
  const auto slider = std::max_element(contacts.begin(), contacts.end(), [&](const auto& p, const auto& q) {
    return mobilised(p) < mobilised(q);
  });
  const auto roller = std::max_element(contacts.begin(), contacts.end(),
                                       [&](const auto& p, const auto& q) { return rolled(p) < rolled(q); });
  packing.law += test::changed("friction.coefficient", mobilised(*slider));
  packing.law += test::changed("rolling.coefficient", rolled(*roller));
  test::shear_spring(*slider) *= 2.0;
  test::rolling_spring(*roller) *= 2.0;
  return packing;
}

/// Returns the packing with all positions and the cell disturbed by `size`.
template <int Dim>
Packing<Dim> disturbed(Packing<Dim> packing, double size) {
  RandomStream random(5, 1);
  for (Vec<Dim>& x : packing.grains.position)
    for (int a = 0; a < Dim; ++a) x[a] += size * random.normal();
  packing.cell.matrix(0, 0) *= 1.0 + size;
  packing.cell.matrix(1, 1) *= 1.0 - 0.5 * size;
  return packing;
}

/// Returns the residual after one Newton step from a disturbed equilibrium.
template <int Dim>
double residual_after_one_step(const Packing<Dim>& equilibrium, const BoundaryControl<Dim>& control,
                               double size) {
  StaticSolverOptions one_step;
  one_step.target = 0.0;
  one_step.max_iterations = 1;
  one_step.largest_mobilised_share = 1.0;
  return solve_statics(disturbed(equilibrium, size), control, one_step).residual;
}

/// With the exact tangent, the residual after one Newton step is proportional to the square of the disturbance: a tenth
/// of the disturbance gives a hundredth of the residual. With an inexact tangent, it would give only a tenth.
template <int Dim>
void expect_quadratic(const Packing<Dim>& equilibrium, const BoundaryControl<Dim>& control) {
  const double after_large = residual_after_one_step(equilibrium, control, 1e-4);
  const double after_small = residual_after_one_step(equilibrium, control, 1e-5);
  EXPECT_GT(after_large, 1e-10);  // well above rounding errors
  EXPECT_NEAR(after_large / after_small, 100.0, 10.0);
}
void expect_quadratic(const Packing<2>& equilibrium) {
  expect_quadratic(equilibrium, BoundaryControl<2>::normal_stress(kTarget, 0.0));
}

TEST(StaticSolver, StepsWithTheExactTangent) {
  const Packing<2> equilibrium = soft_equilibrium();
  double softest = 0.0;
  for (const Contact<2>& c : equilibrium.contacts) softest = std::min(softest, c.gap);
  EXPECT_LT(softest, -0.05);
  expect_quadratic(equilibrium);
}

TEST(StaticSolver, StepsWithTheExactTangentWhereContactsSlideAndYield) {
  const Packing<2> equilibrium = with_yielding_contacts(soft_equilibrium());
  Packing<2> refreshed = equilibrium;
  refresh_contacts(refreshed);
  EXPECT_LT(residuals(refreshed, kTarget).force, 1e-7);  // still the same equilibrium
  const auto count = [&](bool Contact<2>::*flag) {
    return std::count_if(refreshed.contacts.begin(), refreshed.contacts.end(),
                         [&](const auto& c) { return c.*flag; });
  };
  EXPECT_EQ(count(&Contact<2>::sliding), 1);
  EXPECT_EQ(count(&Contact<2>::rolling_yield), 1);
  expect_quadratic(equilibrium);
}

Law sphere_law() {
  Law law;
  law += test::linear(10.0);
  law += test::coulomb(0.5, 8.0);
  law += test::rolling_spring(0.1, 0.3);
  return law;
}

/// Returns spheres on the sites of a face-centred cubic crystal of 2 x 2 x 2 cells, with overlaps of a tenth of
/// a diameter.
Packing<3> crystal() {
  Packing<3> cube;
  cube.law = sphere_law();
  cube.cell.matrix = std::sqrt(2.0) * Mat<3>::Identity();
  cube.grains = Grains<3>::with_size(4);
  const double half = std::sqrt(0.5);
  cube.grains.position = {Vec<3>(0.1, 0.1, 0.1), Vec<3>(0.1 + half, 0.1 + half, 0.1),
                          Vec<3>(0.1 + half, 0.1, 0.1 + half), Vec<3>(0.1, 0.1 + half, 0.1 + half)};
  cube.grains.radius.assign(4, 0.55);
  cube.grains.mass.assign(4, 1.0);
  Packing<3> packing = tiled<3>(cube, {2, 2, 2});
  find_contacts(packing);
  return packing;
}

Vec<3> load_on(const Packing<3>& packing) {
  return static_stress(packing).diagonal();
}

/// Returns the crystal in equilibrium with springs that were stretched at random up to half their limits.
Packing<3> strained_crystal() {
  Packing<3> packing = crystal();
  RandomStream random(3, 1);
  for (Contact<3>& c : packing.contacts) {
    Vec<3> direction;
    for (int a = 0; a < 3; ++a) {
      direction[a] = random.normal();
      test::rolling_spring(c)[a] = 0.005 * random.normal();
    }
    test::shear_spring(c) = 0.02 * to_shear<double>(c.normal, direction).normalized();
  }
  StaticSolverOptions options;
  options.largest_displacement = 0.2;
  options.max_iterations = 40;
  const StaticSolution<3> solution = solve_statics(packing, load_on(crystal()), options);
  EXPECT_TRUE(solution.converged) << solution.reason;
  return solution.packing;
}

TEST(StaticSolver, BringsACrystalOfSpheresBackToBalance) {
  const Vec<3> target = load_on(crystal());
  const StaticSolution<3> solution = solve_statics(disturbed(crystal(), 1e-4), target, StaticSolverOptions{});
  ASSERT_TRUE(solution.converged) << solution.reason;
  EXPECT_LE(solution.iterations, 4);  // quadratic convergence
  const Residuals left = residuals(solution.packing, target);
  EXPECT_LT(std::max({left.force, left.moment, left.stress}), 1e-8);
}

TEST(StaticSolver, StepsWithTheExactTangentAmongSpheresUnderFriction) {
  const Packing<3> equilibrium = strained_crystal();
  double shear = 0.0, rolling = 0.0;
  for (const Contact<3>& c : equilibrium.contacts) {
    shear += c.shear_force.norm() / c.normal_force / static_cast<double>(equilibrium.contacts.size());
    rolling += c.rolling_moment.norm() / c.normal_force / static_cast<double>(equilibrium.contacts.size());
  }
  EXPECT_GT(shear, 0.05);
  EXPECT_GT(rolling, 0.001);
  expect_quadratic(equilibrium, BoundaryControl<3>::normal_stress(load_on(crystal()), 0.0));
}

TEST(StaticSolver, AnswersAsTheModuliSayInASkewedCell) {
  const Packing<2> start = tiled<2>(test::triangular(1.0, test::elastic_law(10.0, 8.0, 0.3)), {4, 4});
  const Mat<2> carried = static_stress(start);
  auto control = BoundaryControl<2>::normal_stress(carried.diagonal(), 0.0);
  constexpr double kShear = 1e-5;
  control.imposed[2] = Imposed::stress;
  control.target[2] = carried(0, 1) + kShear;
  const StaticSolution<2> solution = solve_statics(start, control, StaticSolverOptions{});
  ASSERT_TRUE(solution.converged) << solution.reason;
  const Mat<2> stress = static_stress(solution.packing);
  EXPECT_LT((Vec<3>(stress(0, 0), stress(1, 1), stress(0, 1)) - control.target).norm(), 1e-8);

  ModuliOptions options;
  options.strains = StrainSet::full;
  options.prestress = true;
  const Mat<2> deformation = (start.cell.matrix.inverse() * solution.packing.cell.matrix).transpose();
  EXPECT_EQ(deformation(1, 0), 0.0);
  // Shortening is positive. The solution has an error of 1e-8, while the load is 1e-5.
  EXPECT_NEAR(-deformation(0, 1) * elastic_moduli(start, options).G / kShear, 1.0, 1e-3);
}

TEST(StaticSolver, HoldsTheStrainsThatAreFixed) {
  const Packing<2> start = tiled<2>(test::triangular(1.0, test::elastic_law(10.0, 8.0, 0.3)), {4, 4});
  auto control = BoundaryControl<2>::fixed();
  control.imposed[0] = Imposed::stress;
  control.target[0] = 1.001 * static_stress(start)(0, 0);
  const StaticSolution<2> solution = solve_statics(start, control, StaticSolverOptions{});
  ASSERT_TRUE(solution.converged) << solution.reason;
  EXPECT_LT(solution.packing.cell.matrix(0, 0), start.cell.matrix(0, 0));
  EXPECT_EQ(solution.packing.cell.matrix(1, 1), start.cell.matrix(1, 1));
  EXPECT_NEAR(static_stress(solution.packing)(0, 0), control.target[0], 1e-8);
}

TEST(StaticSolver, ComesToTheSameEquilibriumByEachWayOfSolving) {
  const Packing<3> start = disturbed(strained_crystal(), 1e-4);
  const Vec<3> load = load_on(start);
  StaticSolverOptions options;
  options.method = TangentMethod::lu;
  const Packing<3> expected = solve_statics(start, load, options).packing;
  for (const TangentMethod method : {TangentMethod::cholesky, TangentMethod::diagonal}) {
    options.method = method;
    const StaticSolution<3> found = solve_statics(start, load, options);
    EXPECT_TRUE(found.converged) << found.reason;
    EXPECT_LE(found.iterations, 4);
    // In the two packings, the net forces are below 1e-8 times the force at an overlap of a tenth of a diameter.
    EXPECT_LT((found.packing.cell.matrix - expected.cell.matrix).norm(), 1e-7);
    for (int i = 0; i < start.grains.size(); ++i)
      EXPECT_LT((found.packing.grains.position[i] - expected.grains.position[i]).norm(), 1e-7) << i;
  }
}

/// A gas has no contacts that could balance the pressure, so no equilibrium exists. Newton steps must not invert the
/// lattice vectors of the cell.
template <int Dim>
void expect_no_equilibrium_of_a_gas() {
  for (const double pressure : {1e-3, 0.5, 10.0})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Packing<Dim> gas = test::gas_of<Dim>(30, test::cohesive_law(), Dim == 2 ? 0.5 : 0.4, seed);
      const StaticSolution<Dim> solution = solve_statics(gas, Vec<Dim>(Vec<Dim>::Constant(pressure)), {});
      EXPECT_FALSE(solution.converged) << pressure << " " << seed;
      EXPECT_GT(solution.packing.cell.matrix.diagonal().minCoeff(), 0.0) << pressure << " " << seed;
    }
}

TEST(StaticSolver, LeavesAGasUnderPressureWithACell) {
  expect_no_equilibrium_of_a_gas<2>();
  expect_no_equilibrium_of_a_gas<3>();
}

}  // namespace
}  // namespace floc
