#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/tables/consolidation_fits.h"
#include "floc/tables/table_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct PreconsolidationArguments {
  std::vector<std::string> inputs;
  std::string branch;
  std::string columns;
  std::string phi_limit = "1";
  Printing printing;
};

int fit_tables(const PreconsolidationArguments& arguments) {
  Printing printing = arguments.printing;
  const double phi_limit = phi_limit_of(arguments.phi_limit);
  const ColumnNames columns =
      parse_column_names(arguments.columns, names_with_densities({"P_star", "branch"}), printing);
  Json array = Json::array();
  Table table = preconsolidation_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns, {"P_star"}, OedometerPressure::driven, phi_limit);
    log_notes(path);
    const std::vector<ReloadingFit> fits = preconsolidation_fits(path, arguments.branch);
    if (fits.empty()) {
      spdlog::warn(
          "{}: no preconsolidation pressure can be fitted: the pressure does not rise again after it has "
          "fallen, so there is no reloading branch",
          path.name);
      // The table is valid, although it contains no reloading branch. The exit code is therefore kNotConverged, not
      // kBadInput.
      return static_cast<int>(kNotConverged);
    }
    int worst = kDone;
    for (const ReloadingFit& reloading : fits) {
      const auto& [branch, fit] = reloading;
      const std::string what =
          fmt::format("{} in rows {}", reloading.is_first_loading() ? "first loading" : "reloading branch",
                      ranges(branch.loading.rows));
      if (!fit.found()) {
        spdlog::warn("{}: {}: no preconsolidation pressure can be fitted: {}", path.name, what,
                     fit.failure_reason);
        worst = worse(worst, kNotConverged);
      } else {
        spdlog::info("{}: a preconsolidation pressure was fitted to the {}{}", path.name, what,
                     reloading.is_first_loading()
                         ? ""
                         : fmt::format("; the largest pressure before it is {:.6g}", branch.largest_before));
      }
      for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", path.name, warning);
      array.push_back(as_json(path, reloading));
      add_rows(path, reloading, table);
    }
    return worst;
  });
  print_fit(array, table, table.columns.size(), printing);
  return code;
}

}  // namespace

Command add_fit_preconsolidation(CommandLine fit) {
  auto arguments = std::make_shared<PreconsolidationArguments>();
  CommandLine app = fit.add_subcommand("preconsolidation",
                                       "fit the preconsolidation pressure of overconsolidated samples, to "
                                       "reloading branches or a first loading");
  app.add_option("TABLE", arguments->inputs,
                 "tables with the columns P_star (reduced pressure), phi (solid fraction) or void_ratio, and "
                 "optionally branch; or directories of `floc run`; - for a table on stdin")
      .required();
  app.add_option("--branch", arguments->branch,
                 "branches to fit: reloading, first (the first loading of a sample that was loaded "
                 "before the test) or all [reloading if the table has a reloading branch, otherwise first]")
      .one_of({"reloading", "first", "all"});
  add_phi_limit_option(app, arguments->phi_limit);
  add_columns_option(app, arguments->columns, "P_star, phi, void_ratio or another density, branch");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
