#include <spdlog/spdlog.h>

#include <memory>
#include <optional>

#include "elastic_fits.h"
#include "fit_commands.h"
#include "output.h"

namespace floc {
namespace {

struct ElasticArguments {
  std::vector<std::string> inputs;
  std::string state;
  std::string columns;
  std::string format;
};

void add_table_rows(const PathTable& path, const Loading& branch, const ElasticFit& fit,
                    const std::optional<StateModuli>& state, Table& table) {
  const auto add = [&](const char* source, const FittedParameter& p, double rms) {
    std::vector<TableValue> row = {path.name, std::string(source), p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    row.push_back(p.name == "phi_unloaded" || path.unit.empty() ? TableValue() : TableValue(path.unit));
    for (const TableValue& cell :
         std::vector<TableValue>{branch.curve.P_star.back(), branch.curve.P_star.front(),
                                 static_cast<std::int64_t>(branch.rows.size()), rms})
      row.push_back(cell);
    table.rows.push_back(std::move(row));
  };
  for (const FittedParameter& p : fit.parameters) add("fit", p, fit.rms);
  if (!state) return;
  const double rms = distance_from(*state, branch.curve);
  add("state", {"B", state->B, {}, {}, {}, true}, rms);
  add("state", {"B_S", state->B_S, {}, {}, {}, true}, rms);
}

int fit_tables(const ElasticArguments& arguments) {
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P", "P_star", "phi", "void_ratio", "branch"});
  Json array = Json::array();
  Table table{{"sample", "source", "parameter", "value", "stderr", "low95", "high95", "identified", "unit",
               "P_low", "P_high", "n_points", "rms"},
              {}};
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns, {"P", "P_star"});
    const std::vector<ElasticBranch> branches = elastic_branches(path, arguments.state);
    if (branches.empty()) {
      spdlog::warn("{}: no fit: the pressure never falls, so there is no unloading branch", path.name);
      return static_cast<int>(kNotConverged);
    }
    int worst = kDone;
    for (const ElasticBranch& b : branches) {
      const std::string rows = ranges(b.branch.rows);
      if (!b.fit.found()) {
        spdlog::warn("{}: rows {}: no fit: {}", path.name, rows, b.fit.refusal);
        worst = worse(worst, kNotConverged);
      }
      for (const std::string& warning : b.fit.warnings)
        spdlog::warn("{}: rows {}: warning: {}", path.name, rows, warning);
      array.push_back(as_json(path, b));
      add_table_rows(path, b.fitted, b.fit, b.state, table);
    }
    return worst;
  });
  print_fit(array, table, table.columns.size(), arguments.format);
  return code;
}

}  // namespace

Command add_fit_elastic(CommandLine fit) {
  auto arguments = std::make_shared<ElasticArguments>();
  CommandLine app = fit.add_subcommand(
      "elastic", "bulk modulus from unloading branches, compared with that of a saved state");
  app.add_option(
         "TABLE", arguments->inputs,
         "tables with columns P (or P_star), phi (or void_ratio); directories of `floc run`; - is stdin")
      .required();
  app.add_option("--state", arguments->state,
                 "state whose computed modulus is printed beside the fit [the state of the branch's first row, "
                 "or, for a curved branch, of the middle row of its straight part, if that state is there]");
  add_columns_option(app, arguments->columns, "P, P_star, phi, void_ratio, branch");
  add_format_option(app, arguments->format);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
