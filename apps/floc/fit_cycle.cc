#include <spdlog/spdlog.h>

#include <memory>

#include "fit_commands.h"
#include "fit_tables.h"
#include "floc/fitting/pressure_cycle.h"
#include "output.h"

namespace floc {
namespace {

struct Arguments {
  std::vector<std::string> inputs;
  std::string columns;
  std::string format;
};

void add_rows(const PathTable& path, const PressureCycle& cycle, Table& table) {
  const TableValue unit = or_undefined(path.unit);
  const TableValue work = or_undefined(cycle.work);
  for (std::size_t k = 0; k < cycle.P.size(); ++k)
    table.rows.push_back({path.name, ranges(cycle.up.rows), ranges(cycle.down.rows), cycle.P[k],
                          cycle.phi_up[k], cycle.phi_down[k], cycle.phi_down[k] - cycle.phi_up[k],
                          cycle.up.curve.P_star.back(), work, unit});
}

int run_cycles(const Arguments& arguments) {
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P", "P_star", "phi", "void_ratio", "branch"});
  Table table{
      {"sample", "rows_up", "rows_down", "P", "phi_up", "phi_down", "dphi_irr", "P_turn", "work", "unit"}, {}};
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns, {"P", "P_star"});
    int outcome = kNotConverged;
    for (const PressureCycle& cycle : pressure_cycles(path.rows)) {
      if (cycle.P.empty()) continue;
      add_rows(path, cycle, table);
      outcome = kDone;
    }
    if (outcome != kDone)
      spdlog::warn("{}: no cycle: no pressure comes back after it has grown and fallen", path.name);
    return outcome;
  });
  print_table(table, arguments.format);
  return code;
}

}  // namespace

Command add_fit_cycle(CommandLine fit) {
  auto arguments = std::make_shared<Arguments>();
  CommandLine app = fit.add_subcommand("cycle", "what cycles of pressure leave: change of Phi, and their work");
  app.add_option(
         "TABLE", arguments->inputs,
         "tables with columns P (or P_star), phi (or void_ratio); directories of `floc run`; - is stdin")
      .required();
  add_columns_option(app, arguments->columns, "P, P_star, phi, void_ratio, branch");
  add_format_option(app, arguments->format);
  return {app, [arguments] { return run_cycles(*arguments); }};
}

}  // namespace floc
