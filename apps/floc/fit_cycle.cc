#include <spdlog/spdlog.h>

#include <memory>

#include "fit_commands.h"
#include "output.h"
#include "table_fits.h"

namespace floc {
namespace {

struct CycleArguments {
  std::vector<std::string> inputs;
  std::string columns;
  std::string format;
};

int run_cycles(const CycleArguments& arguments) {
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P", "P_star", "phi", "void_ratio", "branch"});
  Table table = cycle_table();
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns, {"P", "P_star"});
    log_notes(path);
    if (add_cycles(path, table) > 0) return int{kDone};
    spdlog::warn("{}: no cycle: no pressure is reached both on loading and on the unloading after it",
                 path.name);
    return int{kNotConverged};
  });
  print_table(table, arguments.format);
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
  add_format_option(app, arguments->format);
  return {app, [arguments] { return run_cycles(*arguments); }};
}

}  // namespace floc
