#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "floc/elasticity/moduli.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/relaxer.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"

namespace floc {
namespace {

/// Returns an equilibrium under a pressure.
Packing<2> equilibrium(int n, const Law& law, double pressure, std::uint64_t seed) {
  const Vec<2> target = Vec<2>::Constant(pressure);
  RelaxationOptions options;
  options.strain_rate_cap = law.pull_off_force() > 0.0 ? std::optional<double>(0.05) : std::nullopt;
  Relaxer<2> relaxer(options, test::gas_of(n, law, 0.5, seed), target);
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) status = relaxer.advance();
  EXPECT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
  return relaxer.packing();
}

Packing<2> solved(const Packing<2>& start, const Vec<2>& target) {
  StaticSolverOptions options;
  options.target = 1e-11;
  options.max_iterations = 30;
  const StaticSolution<2> solution = solve_statics(start, target, options);
  // The rounding error of absolute positions limits the residual to a value near the target of the solver.
  EXPECT_LT(solution.residual, 1e-9) << solution.reason;
  return solution.packing;
}

/// Solves for the equilibria at pressure + step and at pressure - step. Returns half the difference of their
/// logarithmic strains.
Vec<2> strain_found(const Packing<2>& start, double pressure, const Vec<2>& step) {
  const Packing<2> more = solved(start, Vec<2>::Constant(pressure) + step);
  const Packing<2> less = solved(start, Vec<2>::Constant(pressure) - step);
  EXPECT_EQ(more.contacts.size(), less.contacts.size());
  for (const Packing<2>* p : {&more, &less})
    EXPECT_TRUE(std::none_of(p->contacts.begin(), p->contacts.end(),
                             [](const auto& c) { return c.sliding || c.rolling_yield; }));
  return -0.5 * (more.cell.matrix.diagonal().array().log() - less.cell.matrix.diagonal().array().log());
}

/// Imposes small stress steps and finds the resulting strains. The moduli times these strains should be the stress
/// steps. Returns the largest relative difference between the two.
double worst_difference(const Packing<2>& start, double pressure, double relative_step, bool prestress) {
  ModuliOptions options;
  options.prestress = prestress;
  const Mat<2> C = elastic_moduli(start, options).C;
  double worst = 0.0;
  for (const Vec<2>& direction : {Vec<2>(1.0, 1.0), Vec<2>(1.0, -1.0)}) {
    const Vec<2> step = relative_step * pressure * direction;
    worst = std::max(worst, (C * strain_found(start, pressure, step) - step).norm() / step.norm());
  }
  return worst;
}

TEST(ModuliAndRelaxation, AgreeOnACohesivePacking) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Packing<2> packing = solved(equilibrium(40, test::cohesive_law(), 1.0, seed), Vec<2>::Constant(1.0));
    // The remaining difference, at most 2e-5 for any step, comes from geometric terms of the tangential forces, which
    // the stiffness matrix K omits.
    EXPECT_LT(worst_difference(packing, 1.0, 1e-3, true), 1e-4);
    EXPECT_GT(worst_difference(packing, 1.0, 1e-3, false), 2e-4);
  }
}

TEST(ModuliAndRelaxation, AgreeOnAFrictionlessPackingWherePrestressCounts) {
  Law law;
  law += test::linear(1e3);
  law += test::viscous_damping(0.1);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Packing<2> packing = solved(equilibrium(40, law, 1.0, seed), Vec<2>::Constant(1.0));
    // Without tangential forces the difference is quadratic in the step. Prestress changes the moduli by 5 to
    // 40 %.
    EXPECT_LT(worst_difference(packing, 1.0, 1e-4, true), 1e-6);
    EXPECT_GT(worst_difference(packing, 1.0, 1e-4, false), 1e-2);
  }
}

TEST(Bounds, AreInOrderOnEquilibria) {
  Law law = test::cohesive_law();
  // adhesion only in contact, because the theorem excludes attractions at a distance
  law += test::constant_adhesion(1.0);
  for (const std::uint64_t seed : {1, 2})
    for (const double pressure : {0.1, 1.0, 10.0}) {
      const Packing<2> packing = solved(equilibrium(40, law, pressure, seed), Vec<2>::Constant(pressure));
      const Moduli m = elastic_moduli(packing, {});
      const double slack = 1e-9 * m.B;  // relative error of the balance of forces
      EXPECT_GT(m.bounds.B_reuss, 0.0);
      EXPECT_LE(m.bounds.B_reuss, m.B_S + slack);
      EXPECT_LE(m.B_S, m.B + slack);
      EXPECT_LE(m.B, m.bounds.B_voigt + slack);
      EXPECT_LE(m.G, m.bounds.G_voigt + slack);
    }
}

}  // namespace
}  // namespace floc
