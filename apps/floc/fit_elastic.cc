#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>

#include "fit_commands.h"
#include "fit_parameters.h"
#include "fit_tables.h"
#include "floc/base/error.h"
#include "floc/fitting/elastic_line.h"
#include "output.h"
#include "state_moduli.h"

namespace floc {
namespace {

struct Arguments {
  std::vector<std::string> inputs;
  std::string state;
  std::string columns;
  std::string format;
};

/// The state to compare with: the one asked for, else that of the branch's first row if it lies beside the
/// table.
std::optional<StateModuli> find_state(const Arguments& arguments, const PathTable& path, int row) {
  return arguments.state.empty() ? moduli_of_row(path, row) : std::optional(moduli_of(arguments.state));
}

/// The points of a branch that were fitted: all of them, or the straight part of a curved one.
Loading part_fitted(const Loading& branch, const ElasticFit& fit) {
  if (fit.n_points == 0) return branch;
  const auto part = [&](const auto& all) {
    return std::decay_t<decltype(all)>(all.begin() + fit.first, all.begin() + fit.first + fit.n_points);
  };
  Loading fitted = branch;
  fitted.curve.P_star = part(branch.curve.P_star);
  fitted.curve.phi = part(branch.curve.phi);
  fitted.rows = part(branch.rows);
  return fitted;
}

/// Root mean square distance of ln Phi from the line of a state.
double distance_from(const StateModuli& state, const ConsolidationCurve& branch) {
  double sum = 0.0;
  for (std::size_t i = 0; i < branch.phi.size(); ++i)
    sum += std::pow(std::log(branch.phi[i] / state.phi) - (branch.P_star[i] - state.pressure) / state.B_S, 2);
  return std::sqrt(sum / static_cast<double>(branch.phi.size()));
}

/// @param fitted  the points of the branch that were fitted
Json as_json(const PathTable& path, const Loading& branch, const Loading& fitted, const ElasticFit& fit,
             const std::optional<StateModuli>& state) {
  Json object;
  object["sample"] = path.name;
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.refusal);
  object["rows_used"] = branch.rows;
  object["window"] = Json{branch.curve.P_star.back(), branch.curve.P_star.front()};
  object["pressure_unit"] = path.unit.empty() ? Json(nullptr) : Json(path.unit);
  object["n_points"] = branch.rows.size();
  object["fitted_rows"] = fitted.rows;
  object["fitted_window"] = Json{fitted.curve.P_star.back(), fitted.curve.P_star.front()};
  object["parameters"] = parameters_as_json(fit.parameters);
  object["rms"] = fit.found() ? Json(fit.rms) : Json(nullptr);
  object["secant_low"] = number_or_null(fit.secant_low);
  object["secant_high"] = number_or_null(fit.secant_high);
  object["state"] = nullptr;
  if (state)
    object["state"] = {{"file", state->file}, {"B", state->B},
                       {"B_S", state->B_S},   {"P", state->pressure},
                       {"phi", state->phi},   {"rms", distance_from(*state, fitted.curve)}};
  object["warnings"] = fit.warnings;
  return object;
}

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

int fit_tables(const Arguments& arguments) {
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P", "P_star", "phi", "void_ratio", "branch"});
  Json array = Json::array();
  Table table{{"sample", "source", "parameter", "value", "stderr", "low95", "high95", "identified", "unit",
               "P_low", "P_high", "n_points", "rms"},
              {}};
  const int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    const PathTable path = read_path(file, columns, {"P", "P_star"});
    const std::vector<Loading> branches = unloadings(path.rows);
    if (branches.empty()) {
      spdlog::warn("{}: no fit: the pressure falls nowhere, there is no unloading branch", path.name);
      return static_cast<int>(kNotConverged);
    }
    int worst = kDone;
    for (const Loading& branch : branches) {
      ElasticFit fit = fit_elastic(branch.curve.P_star, branch.curve.phi);
      const Loading fitted = part_fitted(branch, fit);
      const auto first = find_state(arguments, path, fitted.rows.front());
      const auto last = find_state(arguments, path, fitted.rows.back());
      if (fit.is_curved && first && last) hold_against(first->B_S, last->B_S, fit);
      const auto state =
          fit.is_curved ? find_state(arguments, path, fitted.rows[fitted.rows.size() / 2]) : first;
      if (!fit.found()) {
        spdlog::warn("{}: rows {}: no fit: {}", path.name, ranges(branch.rows), fit.refusal);
        worst = worse(worst, kNotConverged);
      }
      for (const std::string& warning : fit.warnings)
        spdlog::warn("{}: rows {}: warning: {}", path.name, ranges(branch.rows), warning);
      array.push_back(as_json(path, branch, fitted, fit, state));
      add_table_rows(path, fitted, fit, state, table);
    }
    return worst;
  });
  print_fit(array, table, table.columns.size(), arguments.format);
  return code;
}

}  // namespace

Command add_fit_elastic(CommandLine fit) {
  auto arguments = std::make_shared<Arguments>();
  CommandLine app =
      fit.add_subcommand("elastic", "bulk modulus from unloading branches, beside that of a saved state");
  app.add_option(
         "TABLE", arguments->inputs,
         "tables with columns P (or P_star), phi (or void_ratio); directories of `floc run`; - is stdin")
      .required();
  app.add_option("--state", arguments->state,
                 "state whose computed modulus stands beside the fit [that of the branch's first row, of a "
                 "curved one that of "
                 "the middle row of its straight part, if it is there]");
  add_columns_option(app, arguments->columns, "P, P_star, phi, void_ratio, branch");
  add_format_option(app, arguments->format);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
