#include "floc/relaxation/static_solver.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "floc/packing/contact_forces.h"
#include "floc/relaxation/relaxer.h"
#include "support/dynamics.h"

namespace floc {
namespace {

const Vec<2> kTarget(0.5, 0.5);

/// An equilibrium of grains so soft that their overlaps are a tenth of a diameter: the terms of the tangent that are of
/// the order of force over branch weigh as much as those of stiffness.
Packing<2> soft_equilibrium() {
  LawParameters law = test::cohesive_law();
  law.normal_stiffness = 10.0;
  law.adhesion = {1.0, 0.05};
  law.friction = {0.5, 8.0};
  law.rolling = {0.05, 0.3};
  RelaxationOptions options;
  options.strain_rate_cap = 0.05;
  Relaxer<2> relaxer(options, test::gas_of(20, law, 0.5), kTarget);
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) status = relaxer.advance();
  EXPECT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
  return relaxer.packing();
}

/// The same equilibrium with the contact that is nearest to sliding put at its cap, and beyond it, so that it slides
/// wherever the grains are displaced to; likewise the one nearest to yielding in rolling.
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
  packing.law.friction->coefficient = mobilised(*slider);
  packing.law.rolling->coefficient = rolled(*roller);
  slider->shear_spring *= 2.0;
  roller->rolling_spring *= 2.0;
  return packing;
}

/// Residual that one Newton step leaves of a disturbance of this size of all positions and both sides.
double residual_after_one_step(const Packing<2>& equilibrium, double disturbance) {
  Packing<2> disturbed = equilibrium;
  RandomStream random(5, 1);
  for (Vec<2>& x : disturbed.grains.position)
    for (int a = 0; a < 2; ++a) x[a] += disturbance * random.normal();
  disturbed.cell.matrix(0, 0) *= 1.0 + disturbance;
  disturbed.cell.matrix(1, 1) *= 1.0 - 0.5 * disturbance;
  StaticSolverOptions one_step;
  one_step.target = 0.0;
  one_step.max_iterations = 1;
  return solve_statics(disturbed, kTarget, one_step).residual;
}

/// A step with the exact tangent leaves what is quadratic in the disturbance: a hundredth for a tenth. Any error of the
/// tangent would leave a tenth.
void expect_quadratic(const Packing<2>& equilibrium) {
  const double after_large = residual_after_one_step(equilibrium, 1e-4);
  const double after_small = residual_after_one_step(equilibrium, 1e-5);
  EXPECT_GT(after_large, 1e-10);  // well above rounding
  EXPECT_NEAR(after_large / after_small, 100.0, 10.0);
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
  Packing<2> seen = equilibrium;
  refresh_contacts(seen);
  EXPECT_LT(residuals(seen, kTarget).force, 1e-7);  // still the same equilibrium
  const auto count = [&](bool Contact<2>::*flag) {
    return std::count_if(seen.contacts.begin(), seen.contacts.end(), [&](const auto& c) { return c.*flag; });
  };
  EXPECT_EQ(count(&Contact<2>::sliding), 1);
  EXPECT_EQ(count(&Contact<2>::rolling_yield), 1);
  expect_quadratic(equilibrium);
}

}  // namespace
}  // namespace floc
