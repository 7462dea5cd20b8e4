#include <spdlog/spdlog.h>

#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/tables/table_fits.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct CycleArguments {
  std::vector<std::string> inputs;
  std::string columns;
  Printing printing;
};

int run_cycles(const CycleArguments& arguments) {
  Printing printing = arguments.printing;
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P", "P_star", "phi", "void_ratio", "branch"}, printing);
  Table table = cycle_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns, {"P", "P_star"});
    log_notes(path);
    if (add_cycles(path, table) > 0) return int{kDone};
    spdlog::warn("{}: no cycle: no pressure is reached both on loading and on the unloading after it",
                 path.name);
    return int{kNotConverged};
  });
  print_table(table, printing);
  return code;
}

}  // namespace

Command add_fit_cycle(CommandLine fit) {
  auto arguments = std::make_shared<CycleArguments>();
  CommandLine app =
      fit.add_subcommand("cycle", "what pressure cycles leave behind: the change of Phi, and their work");
  app.add_option(
         "TABLE", arguments->inputs,
         "tables with columns P (or P_star), phi (or void_ratio); directories of `floc run`; - is stdin")
      .required();
  add_columns_option(app, arguments->columns, "P, P_star, phi, void_ratio, branch");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return run_cycles(*arguments); }};
}

}  // namespace floc
