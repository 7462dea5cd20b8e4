#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/strength_tests.h"

namespace floc {

struct StrengthOptions {
  std::optional<double> critical_from;  ///< see ShearTestOptions::critical_from
  /// axial stresses between which the constrained modulus is computed, see evaluate_oedometer_test()
  std::optional<std::pair<double, double>> modulus_range;
};

/// Parameters that were computed from one test, or from all tests of one kind together.
struct StrengthFit {
  std::string sample;  ///< name of the table; "pooled" for all tests of one kind together
  std::string rows;    ///< rows of the table, as text; empty for all tests of one kind together
  TestKind kind = TestKind::drained;
  std::string unit;  ///< unit of the stresses; empty if the tables have none
  int n = 0;         ///< number of states of the test or, for all tests of one kind together, number of tests
  std::vector<FittedParameter> parameters;
  std::string failure_reason;  ///< reason why there are no parameters; empty if there are parameters
  std::vector<std::string> warnings;
};

/// Evaluates every test by itself, then all tests of each kind together. If the tests are under different lateral
/// stresses, Mohr-Coulomb lines are fitted to their peak and critical states. If all lateral stresses are equal, the
/// parameters are averaged over the tests. K0 and the constrained modulus of oedometer tests are averaged over the
/// samples.
/// @throws InputError if the stresses of two tables are in units that cannot be converted
std::vector<StrengthFit> strength_fits(std::vector<StrengthTest> tests, const StrengthOptions& options);

/// Returns the table of `floc fit strength`, with a row for each parameter.
Table strength_table(const std::vector<StrengthFit>& fits);

/// Returns a fit as the json object that `floc fit strength --format json` prints.
Json as_json(const StrengthFit& fit);

}  // namespace floc
