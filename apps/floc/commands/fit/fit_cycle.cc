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

struct CycleArguments {
  std::vector<std::string> inputs;
  std::string columns;
  std::string phi_limit = "1";
  Printing printing;
};

int run_cycles(const CycleArguments& arguments) {
  Printing printing = arguments.printing;
  const double phi_limit = phi_limit_of(arguments.phi_limit);
  const ColumnNames columns =
      parse_column_names(arguments.columns, names_with_densities({"P", "P_star", "branch"}), printing);
  Table table = cycle_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns, {"P", "P_star"}, OedometerPressure::driven, phi_limit);
    log_notes(path);
    if (add_cycles(path, table) > 0) return int{kDone};
    spdlog::warn(
        "{}: the load path contains no pressure cycle: no pressure is reached both on loading and on the "
        "unloading that follows",
        path.name);
    return int{kNotConverged};
  });
  print_table(table, printing);
  return code;
}

}  // namespace

Command add_fit_cycle(CommandLine fit) {
  auto arguments = std::make_shared<CycleArguments>();
  CommandLine app = fit.add_subcommand("cycle",
                                       "evaluate pressure cycles: the change of the solid fraction Phi that "
                                       "remains after each cycle, and the work done in it");
  app.add_option("TABLE", arguments->inputs,
                 "tables with the columns P (pressure) or P_star (reduced pressure), and phi (solid fraction) "
                 "or void_ratio; or directories of `floc run`; - for a table on stdin")
      .required();
  add_phi_limit_option(app, arguments->phi_limit);
  add_columns_option(app, arguments->columns, "P, P_star, phi, void_ratio or another density, branch");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return run_cycles(*arguments); }};
}

}  // namespace floc
