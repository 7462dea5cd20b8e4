#include <spdlog/spdlog.h>

#include <cmath>
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

void add_table_rows(const PathTable& path, const ElasticBranch& b, Table& table) {
  const auto add = [&](const char* source, const FittedParameter& p, const Loading& points, double rms,
                       const std::string& stress) {
    std::vector<TableValue> row = {path.name, std::string(source), p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    row.push_back(p.name == "phi_unloaded" || path.unit.empty() ? TableValue() : TableValue(path.unit));
    for (const TableValue& cell :
         std::vector<TableValue>{points.curve.P_star.back(), points.curve.P_star.front(),
                                 static_cast<std::int64_t>(points.rows.size()), rms, or_undefined(stress)})
      row.push_back(cell);
    table.rows.push_back(std::move(row));
  };
  for (const FittedParameter& p : b.parameters())
    if (p.name == "M")
      add("fit", p, b.driven_fitted, b.driven->rms, "driven");
    else
      add("fit", p, b.fitted, b.fit.rms, path.stress);
  if (!b.state) return;
  const double rms = distance_from(*b.state, b.fitted.curve);
  add("state", {"B", b.state->B, {}, {}, {}, true}, b.fitted, rms, path.stress);
  add("state", {"B_S", b.state->B_S, {}, {}, {}, true}, b.fitted, rms, path.stress);
  if (b.state->M && b.driven)
    add("state", {"M", *b.state->M, {}, {}, {}, true}, b.driven_fitted, std::nan(""), "driven");
}

int fit_tables(const ElasticArguments& arguments) {
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P", "P_star", "phi", "void_ratio", "branch"});
  Json array = Json::array();
  Table table{{"sample", "source", "parameter", "value", "stderr", "low95", "high95", "identified", "unit",
               "P_low", "P_high", "n_points", "rms", "stress"},
              {}};
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns, {"P", "P_star"}, OedometerPressure::mean);
    log_notes(path);
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
      for (const std::string& warning : b.warnings())
        spdlog::warn("{}: rows {}: warning: {}", path.name, rows, warning);
      array.push_back(as_json(path, b));
      add_table_rows(path, b, table);
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
  add_format_option(app, arguments->format);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
