#include <spdlog/spdlog.h>

#include <memory>

#include "fit_commands.h"
#include "output.h"
#include "table_fits.h"

namespace floc {
namespace {

struct PreconsolidationArguments {
  std::vector<std::string> inputs;
  std::string columns;
  std::string format;
};

void add_table_rows(const PathTable& path, const Reloading& branch, const PreconsolidationFit& fit,
                    Table& table) {
  for (const FittedParameter& p : fit.parameters) {
    std::vector<TableValue> row = {path.name, p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    row.push_back(p.name != "P_c" || path.unit.empty() ? TableValue() : TableValue(path.unit));
    for (const TableValue& cell :
         std::vector<TableValue>{branch.largest_before, static_cast<std::int64_t>(branch.loading.rows.size()),
                                 fit.rms, path.stress_of_rows()})
      row.push_back(cell);
    table.rows.push_back(std::move(row));
  }
}

int fit_tables(const PreconsolidationArguments& arguments) {
  const ColumnNames columns = parse_column_names(arguments.columns, {"P_star", "phi", "void_ratio", "branch"});
  Json array = Json::array();
  Table table{{"sample", "parameter", "value", "stderr", "low95", "high95", "identified", "unit",
               "largest_before", "n_points", "rms", "stress"},
              {}};
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns);
    log_notes(path);
    const std::vector<ReloadingFit> fits = preconsolidation_fits(path);
    if (fits.empty()) {
      spdlog::warn("{}: no fit: the pressure does not rise again after a fall, so there is no reloading branch",
                   path.name);
      return static_cast<int>(kNotConverged);
    }
    int worst = kDone;
    for (const ReloadingFit& reloading : fits) {
      const auto& [branch, fit] = reloading;
      const std::string rows = ranges(branch.loading.rows);
      if (!fit.found()) {
        spdlog::warn("{}: rows {}: no fit: {}", path.name, rows, fit.refusal);
        worst = worse(worst, kNotConverged);
      } else {
        spdlog::info("{}: rows {}: reloading after P = {:.6g}", path.name, rows, branch.largest_before);
      }
      for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", path.name, warning);
      array.push_back(as_json(path, reloading));
      add_table_rows(path, branch, fit, table);
    }
    return worst;
  });
  print_fit(array, table, table.columns.size(), arguments.format);
  return code;
}

}  // namespace

Command add_fit_preconsolidation(CommandLine fit) {
  auto arguments = std::make_shared<PreconsolidationArguments>();
  CommandLine app = fit.add_subcommand(
      "preconsolidation", "preconsolidation pressure of overconsolidated samples, from reloading branches");
  app.add_option("TABLE", arguments->inputs,
                 "tables with columns P_star, phi (or void_ratio) and optionally branch; directories of `floc "
                 "run`; - is stdin")
      .required();
  add_columns_option(app, arguments->columns, "P_star, phi, void_ratio, branch");
  add_format_option(app, arguments->format);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
