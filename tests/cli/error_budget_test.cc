#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_program.h"

/// Tests that the program prints the largest source of error together with a result.
namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Prints the moduli of a square lattice: one disk in a square cell of side 1, which touches its own images. The
/// pressure P is the stiffness times the overlap.
Outcome moduli_of_a_square_lattice(const ScratchDirectory& scratch, const std::string& radius,
                                   const std::string& stiffness) {
  write_text(scratch.file("one.csv"), "x,y,radius\n0.3,0.4," + radius + "\n");
  const Outcome converted =
      run_floc("convert one.csv one.h5 --cell '1,0;0,1' --law normal.stiffness=" + stiffness, scratch.path());
  EXPECT_EQ(converted.code, 0) << converted.err;
  return run_floc("moduli one.h5 --format json", scratch.path());
}

TEST(ErrorBudgetOfModuli, NamesWhatLimitsThem) {
  const ScratchDirectory scratch;
  const Outcome o = moduli_of_a_square_lattice(scratch, "0.5005", "1e3");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, testing::Not(HasSubstr("rounding of the positions")));
  const json row = json::parse(o.out).at(0);
  EXPECT_GT(row.at("rounding_floor").get<double>(), 0.0);
  EXPECT_LT(row.at("rounding_floor").get<double>(), 1e-11);
  EXPECT_LT(row.at("residual_force").get<double>(), 1e-11);
  EXPECT_EQ(row.at("n_undecided"), 0);
  EXPECT_EQ(row.at("error_B_equilibrium"), 0.0);
  EXPECT_EQ(row.at("error_B_sampling"), 0.0);
  EXPECT_EQ(row.at("limited_by"), "solver");
}

TEST(ErrorBudgetOfModuli, WarnsOfAToleranceThatPositionsCannotHold) {
  const ScratchDirectory scratch;
  const Outcome o = moduli_of_a_square_lattice(scratch, "0.50000000000005", "1e13");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err,
              HasSubstr("one.h5: warning: rounding of the positions in this state causes net forces of "));
  EXPECT_THAT(o.err, HasSubstr(" which reach the tolerances of equilibrium, 1.0e-03 and 1.0e-03"));
}

TEST(ErrorBudgetOfAFit, NamesWhatLimitsEachParameter) {
  const std::string demo = source_directory() + "/data/tables/demo";
  const Outcome o = run_floc("fit consolidation " + demo + " --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("standard errors of the parameters, with one part from the scatter between "
                               "samples and one from the uncertain pressures at which "
                               "the regimes end"));
  const json pooled = json::parse(o.out).back();
  const json& lambda = pooled.at("error_budget").at("lambda");
  const double scatter = lambda.at("scatter"), regimes = lambda.at("regimes");
  EXPECT_NEAR(std::hypot(scatter, regimes), pooled.at("parameters").at("lambda").at("stderr").get<double>(),
              1e-12);
  EXPECT_EQ(lambda.at("limited_by"), scatter >= regimes ? "samples" : "regimes");
}

}  // namespace
}  // namespace floc::test
