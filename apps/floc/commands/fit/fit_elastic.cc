#include <spdlog/spdlog.h>

#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/tables/elastic_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct ElasticArguments {
  std::vector<std::string> inputs;
  std::string state;
  std::string columns;
  Printing printing;
};

int fit_tables(const ElasticArguments& arguments) {
  Printing printing = arguments.printing;
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P", "P_star", "phi", "void_ratio", "branch"}, printing);
  Json array = Json::array();
  Table table = elastic_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    // The line of B is fitted against the mean stress, also in an oedometer. elastic_branches() fits M to the driven
    // stress.
    const PathTable path = read_path(file, columns, {"P", "P_star"}, OedometerPressure::mean);
    log_notes(path);
    const std::vector<ElasticBranch> branches = elastic_branches(path, arguments.state);
    if (branches.empty()) {
      spdlog::warn("{}: no fit: the pressure never falls, so there is no unloading branch", path.name);
      // The table is sound, so this is no bad input: there is nothing to fit.
      return static_cast<int>(kNotConverged);
    }
    int worst = kDone;
    for (const ElasticBranch& b : branches) {
      const std::string rows = ranges(b.branch.rows);
      if (!b.fit.found()) {
        spdlog::warn("{}: rows {}: no fit: {}", path.name, rows, b.fit.failure_reason);
        worst = worse(worst, kNotConverged);
      }
      for (const std::string& warning : b.warnings())
        spdlog::warn("{}: rows {}: warning: {}", path.name, rows, warning);
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
      "moduli from unloading branches, B against the mean stress and, of oedometers, M against the driven one, "
      "compared with those of a saved state");
  app.add_option(
         "TABLE", arguments->inputs,
         "tables with columns P (or P_star), phi (or void_ratio); directories of `floc run`; - is stdin")
      .required();
  app.add_option("--state", arguments->state,
                 "state whose computed modulus is printed beside the fit [the state of the branch's first row, "
                 "or, for a curved branch, of the middle row of its straight part, if that state is there]");
  add_columns_option(app, arguments->columns, "P, P_star, phi, void_ratio, branch");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
