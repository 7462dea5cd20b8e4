#include "floc/elasticity/error_budget.h"

#include <gtest/gtest.h>

#include <string>

#include "floc/packing/balance.h"
#include "floc/packing/tile.h"
#include "support/lattices.h"

namespace floc {
namespace {

/// Square lattice of 2 x 2 disks under its own stress. In an isotropic stress step, each of the eight contacts
/// stores an eighth of the energy.
State<2> square() {
  State<2> state;
  state.packing = tiled<2>(test::square_frames(2, 1.0, test::elastic_law(1e3, 700.0, 1.0)), {2, 2});
  state.target_stress.setConstant(static_stress(state.packing)(0, 0));
  return state;
}

ErrorBudget budget_of(const State<2>& state) {
  const ModuliOptions options;
  const Moduli moduli = elastic_moduli(state.packing, options);
  const ContactNetwork<2> network = options.loaded_network(state.packing);
  const auto step = step_response(network, moduli.response, StressStep::isotropic);
  return error_budget(state, network, moduli, step ? &*step : nullptr);
}

TEST(ErrorBudget, OfAPerfectCrystalIsRoundingAlone) {
  const ErrorBudget budget = budget_of(square());
  EXPECT_EQ(budget.n_undecided, 0);
  EXPECT_EQ(budget.equilibrium, 0.0);
  EXPECT_LT(budget.sampling, 1e-9);
  EXPECT_LT(budget.residual, 1e-10);
  EXPECT_GT(budget.floor.force, 0.0);
  EXPECT_GT(budget.solver, 0.0);
}

TEST(ErrorBudget, CountsTheEnergyOfContactsThatMightAsWellBeOpen) {
  State<2> state = square();
  state.packing.contacts[3].elastic_force = 0.0;
  const ErrorBudget budget = budget_of(state);
  EXPECT_EQ(budget.n_undecided, 1);
  ASSERT_TRUE(budget.equilibrium);
  EXPECT_NEAR(*budget.equilibrium, 500.0 / 8.0, 1e-9);  // an eighth of B = K_N/2 = 500
  EXPECT_TRUE(std::string(budget.limit()) == "rounding" || std::string(budget.limit()) == "residual");
}

TEST(ErrorBudget, TakesADifferenceOfTheDiagonalForScatter) {
  State<2> state = square();
  for (Contact<2>& c : state.packing.contacts)
    if (c.normal[0] * c.normal[0] > 0.5) c.kn *= 1.2;
  const ErrorBudget budget = budget_of(state);
  EXPECT_NEAR(budget.sampling, 0.25 * 200.0, 1e-9);
  EXPECT_STREQ(budget.limit(), "sampling");
}

}  // namespace
}  // namespace floc
