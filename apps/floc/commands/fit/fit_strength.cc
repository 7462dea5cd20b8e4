#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/base/error.h"
#include "floc/tables/strength_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct StrengthArguments {
  std::vector<std::string> inputs;
  std::string columns, kind;
  std::vector<double> modulus;  ///< two axial stresses; empty if --modulus is not given
  std::optional<double> critical_from;
  Printing printing;
};

std::string described(const StrengthFit& fit) {
  const std::string tests = fmt::format("{} tests", name_of(fit.kind));
  return fit.rows.empty() ? fmt::format("{} {} together", fit.n, tests)
                          : fmt::format("{}: {} test in rows {}", fit.sample, name_of(fit.kind), fit.rows);
}

/// Returns the two stresses of the option `--modulus`; std::nullopt if it was not given.
/// @throws InputError unless both are positive and the second is larger than the first
std::optional<std::pair<double, double>> modulus_range(const std::vector<double>& stresses) {
  if (stresses.empty()) return std::nullopt;
  if (!(stresses[0] > 0.0 && stresses[1] > stresses[0]))
    throw InputError("--modulus", fmt::format("{:g},{:g}: expected two stresses LOW,HIGH with 0 < LOW < HIGH",
                                              stresses[0], stresses[1]));
  return std::pair(stresses[0], stresses[1]);
}

/// Prints on stderr why parameters of some tests could not be computed, and the warnings about the tests.
/// @return exit code
int log_fits(const std::vector<StrengthFit>& fits) {
  int code = kDone;
  for (const StrengthFit& fit : fits) {
    if (!fit.failure_reason.empty())
      spdlog::warn("{}: no parameters can be computed: {}", described(fit), fit.failure_reason);
    if (fit.parameters.empty()) code = kNotConverged;
    for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", described(fit), warning);
  }
  return code;
}

int fit_strength(const StrengthArguments& arguments) {
  Printing printing = arguments.printing;
  const ColumnNames columns = parse_column_names(arguments.columns, strength_names(), printing);
  StrengthOptions options;
  options.critical_from = arguments.critical_from;
  options.modulus_range = modulus_range(arguments.modulus);
  // The tests of all tables are read before any test is evaluated, because strength_fits() also evaluates all tests of
  // one kind together: a Mohr-Coulomb line needs tests under different lateral stresses.
  std::vector<StrengthTest> tests;
  const auto read = [&](const std::string& file) {
    std::vector<StrengthTest> found = read_strength_tests(file, columns, kind_of_test(arguments.kind));
    if (found.empty()) {
      spdlog::warn(
          "{}: the table contains no test with axial strain or simple shear: no row has the control triaxial, "
          "constant_volume, oedometric or simple_shear",
          file);
      return static_cast<int>(kNotConverged);
    }
    std::ranges::move(found, std::back_inserter(tests));
    return static_cast<int>(kDone);
  };
  int code = for_each_table(arguments.inputs, read, tables_of_tests);
  // Without a test, nothing is printed on stdout: an empty table would look like a result.
  if (tests.empty()) return code;
  const std::vector<StrengthFit> fits = strength_fits(std::move(tests), options);
  code = worse(code, log_fits(fits));
  Json array = Json::array();
  for (const StrengthFit& fit : fits) array.push_back(as_json(fit));
  const Table table = strength_table(fits);
  print_fit(array, table, table.columns.size(), printing);
  return code;
}

}  // namespace

Command add_fit_strength(CommandLine fit) {
  auto arguments = std::make_shared<StrengthArguments>();
  CommandLine app = fit.add_subcommand("strength",
                                       "evaluate mechanical tests as a laboratory reports them: friction "
                                       "angles, cohesion and dilatancy angle of "
                                       "drained (biaxial, triaxial) and simple shear tests, strength and pore "
                                       "pressure of undrained tests (at constant volume), K0 and "
                                       "constrained modulus of oedometer tests");
  app.add_option("TABLE", arguments->inputs,
                 "directories of `floc run` whose paths have stages with a driven axis or simple shear, or of "
                 "a campaign; or "
                 "tables of one test each, with the columns sigma1 and sigma3 (stresses along and across the "
                 "axis), strain "
                 "(along the axis) and volumetric_strain, positive in compression, or sigma_n and tau "
                 "(stresses across and "
                 "along the sheared planes), shear_strain and volumetric_strain; or tables with the stresses "
                 "alone, one "
                 "sample at failure in each row; - for a table on stdin")
      .required();
  // This option has no fixed default. If it is not given, read_strength_tests() recognizes simple shear by the columns
  // sigma_n and tau. Any other table with strains is then a drained test, unless `floc run` has written it.
  app.add_option("--kind", arguments->kind,
                 "kind of the test in tables that were not written by `floc run`: drained, undrained (sigma1 "
                 "and sigma3 are effective stresses), oedometer or simple-shear [simple-shear for tables with "
                 "sigma_n and tau, otherwise drained]")
      .one_of({"drained", "undrained", "oedometer", "simple-shear"});
  app.add_option("--critical-from", arguments->critical_from,
                 "axial strain at which the critical state begins [three quarters of the strain of "
                 "the test]")
      .positive();
  // The command line checks only that there are two numbers. modulus_range() checks later that LOW is positive and less
  // than HIGH.
  app.add_option("--modulus", arguments->modulus,
                 "LOW,HIGH: axial stresses between which the constrained modulus is computed [half of "
                 "the largest stress to the largest stress]")
      .delimiter(',')
      .expected(2);
  add_columns_option(app, arguments->columns,
                     "sigma1, sigma3, strain, volumetric_strain, sigma_n, tau, shear_strain");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_strength(*arguments); }};
}

}  // namespace floc
