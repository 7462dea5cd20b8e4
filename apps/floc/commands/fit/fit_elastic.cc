#include <spdlog/spdlog.h>

#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/tables/consolidation_fits.h"
#include "floc/tables/elastic_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct ElasticArguments {
  std::vector<std::string> inputs;
  std::string state;
  std::string columns;
  std::string phi_limit = "1";
  Printing printing;
};

int fit_tables(const ElasticArguments& arguments) {
  Printing printing = arguments.printing;
  const double phi_limit = phi_limit_of(arguments.phi_limit);
  const ColumnNames columns =
      parse_column_names(arguments.columns, names_with_densities({"P", "P_star", "branch"}), printing);
  Json array = Json::array();
  Table table = elastic_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    // The mean stress is read as the pressure, even for oedometer tests, because the bulk modulus B is fitted against
    // the mean stress. For an oedometer test, elastic_branches() also fits the modulus M, against the stress on the
    // driven axis.
    const PathTable path = read_path(file, columns, {"P", "P_star"}, OedometerPressure::mean, phi_limit);
    log_notes(path);
    const std::vector<ElasticBranch> branches = elastic_branches(path, arguments.state);
    if (branches.empty()) {
      spdlog::warn("{}: no modulus can be fitted: the pressure never falls, so there is no unloading branch",
                   path.name);
      // The table is valid, although it contains no unloading branch. The exit code is therefore kNotConverged, not
      // kBadInput.
      return static_cast<int>(kNotConverged);
    }
    int worst = kDone;
    for (const ElasticBranch& b : branches) {
      const std::string rows = ranges(b.branch.rows);
      if (!b.fit.found()) {
        spdlog::warn("{}: unloading branch in rows {}: no modulus can be fitted: {}", path.name, rows,
                     b.fit.failure_reason);
        worst = worse(worst, kNotConverged);
      }
      for (const std::string& warning : b.warnings())
        spdlog::warn("{}: unloading branch in rows {}: warning: {}", path.name, rows, warning);
      array.push_back(as_json(path, b));
      add_rows(path, b, table);
    }
    return worst;
  });
  print_fit(array, table, table.columns.size(), printing);
  return code;
}

}  // namespace

Command add_fit_elastic(CommandLine fit) {
  auto arguments = std::make_shared<ElasticArguments>();
  CommandLine app = fit.add_subcommand(
      "elastic",
      "fit elastic moduli to unloading branches: the bulk modulus B against the mean stress and, for oedometer "
      "tests, the uniaxial modulus M against the stress on the driven axis; compare them with the moduli of a "
      "saved state");
  app.add_option("TABLE", arguments->inputs,
                 "tables with the columns P (pressure) or P_star (reduced pressure), and phi (solid fraction) "
                 "or void_ratio; or directories of `floc run`; - for a table on stdin")
      .required();
  app.add_option(
      "--state", arguments->state,
      "state file whose computed moduli are printed for comparison [the state of the first row of the branch "
      "or, for a curved branch, of the middle row of its straight part, if the file of this state exists]");
  add_phi_limit_option(app, arguments->phi_limit);
  add_columns_option(app, arguments->columns, "P, P_star, phi, void_ratio or another density, branch");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
