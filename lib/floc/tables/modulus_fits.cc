#include "floc/tables/modulus_fits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <utility>

#include "floc/base/error.h"
#include "floc/fitting/correlated_mean.h"
#include "floc/tables/path_density.h"

namespace floc {
namespace {

/// Columns and values that are read from a table of moduli.
struct ModulusColumns {
  const NamedColumns& named;
  UnitColumn pressure;
  std::vector<double> phi;  ///< solid fractions of the rows; empty if the table has none
  std::vector<std::pair<std::string, UnitColumn>> moduli;

  const CsvTable& table() const { return named.table(); }
};

/// Returns whether a column has a value in any row. Tables of floc moduli also have the columns of moduli that none of
/// their states has.
bool has_values(const CsvTable& table, int column) {
  for (int row = 0; row < table.n_rows(); ++row)
    if (!table.is_empty(row, column)) return true;
  return false;
}

std::vector<std::pair<std::string, UnitColumn>> columns_of_moduli(const NamedColumns& named,
                                                                  const std::vector<std::string>& asked) {
  std::vector<std::pair<std::string, UnitColumn>> found;
  for (const std::string& name : asked) found.emplace_back(name, named.unit_column(name));
  if (!asked.empty()) return found;
  for (const std::string& name : default_moduli()) {
    const auto column = named.is_named(name) ? named.unit_column(name) : named.find_exactly(name);
    if (column && has_values(named.table(), column->index)) found.emplace_back(name, *column);
  }
  if (found.empty())
    throw InputError(
        named.table().place(),
        fmt::format(
            "the table has values in none of the columns {}; its columns are {}: expected a table of floc "
            "moduli, or the names of the moduli with --moduli",
            fmt::join(default_moduli(), ", "), fmt::join(named.table().columns(), ", ")));
  return found;
}

ModulusColumns modulus_columns(const NamedColumns& named, const ModulusFitOptions& options) {
  const std::vector<std::string> densities = density_names();
  const bool has_phi =
      std::any_of(densities.begin(), densities.end(), [&](const auto& name) { return named.has(name); });
  return {named, pressure_column(named, {"P", "P_star"}).second,
          has_phi ? solid_fractions(named, options.phi_limit).phi : std::vector<double>{},
          columns_of_moduli(named, options.moduli)};
}

/// For each sample in a table, returns the name and the rows of the sample.
std::vector<std::pair<std::string, std::vector<int>>> samples_of(const CsvTable& table,
                                                                 const std::string& name) {
  std::vector<std::pair<std::string, std::vector<int>>> samples;
  const int file = table.has("file") ? table.column("file") : -1;
  for (int row = 0; row < table.n_rows(); ++row) {
    const std::string sample =
        file < 0 ? name : std::filesystem::path(table.text(row, file)).parent_path().string();
    if (samples.empty() || samples.back().first != sample) samples.push_back({sample, {}});
    samples.back().second.push_back(row);
  }
  return samples;
}

/// Returns the rows of the first loading of a sample.
std::vector<int> of_first_loading(const ModulusColumns& columns, const std::vector<int>& rows) {
  std::vector<PathRow> path;
  for (const int row : rows) {
    const double P = std::max(columns.table().number(row, columns.pressure.index), 0.0);
    path.push_back({"", P, columns.phi.empty() ? 1.0 : columns.phi[static_cast<std::size_t>(row)]});
  }
  std::vector<int> kept;
  for (const int i : first_loading(path).rows) kept.push_back(rows[static_cast<std::size_t>(i)]);
  return kept;
}

/// Fits one law to the given rows, whose moduli are positive.
ModulusFit fit_rows(const ModulusColumns& columns, const std::pair<std::string, UnitColumn>& modulus,
                    ModulusAgainst against, std::vector<int> rows) {
  const auto x = [&](int row) {
    return against == ModulusAgainst::pressure ? columns.table().number(row, columns.pressure.index)
                                               : columns.phi[static_cast<std::size_t>(row)];
  };
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return x(a) < x(b); });
  std::vector<double> at, moduli;
  for (const int row : rows) {
    at.push_back(x(row));
    moduli.push_back(columns.table().number(row, modulus.second.index));
  }
  ModulusFit fit;
  fit.modulus = modulus.first;
  fit.against = against;
  fit.unit = modulus.second.unit;
  fit.n = static_cast<int>(rows.size());
  if (!at.empty()) fit.low = at.front(), fit.high = at.back();
  fit.law = against == ModulusAgainst::pressure ? fit_modulus_of_pressure(at, moduli)
                                                : fit_modulus_of_fraction(at, moduli);
  std::sort(rows.begin(), rows.end());
  fit.rows = std::move(rows);
  return fit;
}

const char* word_of(ModulusAgainst against) {
  return against == ModulusAgainst::pressure ? "P" : "phi";
}

}  // namespace

const std::vector<std::string>& default_moduli() {
  static const std::vector<std::string> names = {"B", "B_S", "G", "G_shear", "M", "E"};
  return names;
}

ModulusFits modulus_fits(const std::string& file, const ColumnNames& columns,
                         const ModulusFitOptions& options) {
  std::vector<std::string> wanted = density_names();
  for (const char* name : {"P", "P_star", "file"}) wanted.emplace_back(name);
  for (const std::vector<std::string>& names : {default_moduli(), options.moduli})
    wanted.insert(wanted.end(), names.begin(), names.end());
  // The wanted names help to distinguish the line of column names from lines with titles.
  const CsvTable table = CsvTable::read(file, wanted_names(wanted, columns));
  const NamedColumns named(table, columns);
  const ModulusColumns all = modulus_columns(named, options);
  ModulusFits result;
  for (const auto& [sample, rows] : samples_of(table, file == "-" ? "stdin" : file)) {
    const std::vector<int> chosen = options.branch == "first" ? of_first_loading(all, rows) : rows;
    if (chosen.size() < rows.size())
      result.notes.push_back(
          fmt::format("{0}: only the {1} rows of the first loading are fitted, of {2} rows in all", sample,
                      chosen.size(), rows.size()));
    for (const auto& modulus : all.moduli) {
      // The rows are selected for each modulus, because a row may lack one modulus but have another one. The laws
      // against pressure and against solid fraction are fitted to one set of rows, so the pressure has to be positive
      // for both laws.
      std::vector<int> positive;
      std::copy_if(chosen.begin(), chosen.end(), std::back_inserter(positive), [&](int row) {
        return table.number(row, all.pressure.index) > 0.0 && !table.is_empty(row, modulus.second.index) &&
               table.number(row, modulus.second.index) > 0.0;
      });
      if (positive.size() < chosen.size())
        result.notes.push_back(fmt::format(
            "{0}: {1} rows are left out of the laws of {2}, because the pressure or {2} is not positive",
            sample, chosen.size() - positive.size(), modulus.first));
      for (const ModulusAgainst against : {ModulusAgainst::pressure, ModulusAgainst::fraction}) {
        if (against == ModulusAgainst::fraction && all.phi.empty()) continue;
        result.fits.push_back(fit_rows(all, modulus, against, positive));
        result.fits.back().sample = sample;
      }
    }
  }
  return result;
}

std::vector<ModulusFit> pooled_over_samples(const std::vector<ModulusFit>& fits) {
  std::vector<ModulusFit> means;
  std::vector<std::pair<std::string, ModulusAgainst>> seen;
  for (const ModulusFit& first : fits) {
    if (std::find(seen.begin(), seen.end(), std::pair(first.modulus, first.against)) != seen.end()) continue;
    seen.emplace_back(first.modulus, first.against);
    // The map sorts the parameters by name. `names` keeps the order in which the law lists the parameters.
    std::map<std::string, std::vector<double>> values;
    std::vector<std::string> names;
    ModulusFit mean;
    for (const ModulusFit& fit : fits) {
      if (fit.modulus != first.modulus || fit.against != first.against || !fit.law.found()) continue;
      mean.low = mean.n == 0 ? fit.low : std::min(mean.low, fit.low);
      mean.high = mean.n == 0 ? fit.high : std::max(mean.high, fit.high);
      ++mean.n;
      for (const FittedParameter& p : fit.law.parameters) {
        if (!p.value) continue;
        if (!values.contains(p.name)) names.push_back(p.name);
        values[p.name].push_back(*p.value);
      }
    }
    // The error of a mean follows from the scatter between samples, and a single sample has no scatter.
    if (mean.n < 2) continue;
    mean.sample = "pooled";
    mean.modulus = first.modulus;
    mean.against = first.against;
    mean.unit = first.unit;
    for (const std::string& name : names) mean.law.parameters.push_back(mean_of_samples(name, values[name]));
    means.push_back(std::move(mean));
  }
  return means;
}

Table modulus_table(const std::vector<ModulusFit>& fits) {
  Table table{{"sample", "modulus", "against", "parameter", "value", "stderr", "low95", "high95", "identified",
               "unit", "low", "high", "n_points", "rms", "systematic"},
              {}};
  for (const ModulusFit& fit : fits)
    for (const FittedParameter& p : fit.law.parameters) {
      std::vector<TableValue> row = {fit.sample, fit.modulus, std::string(word_of(fit.against)), p.name};
      for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
      const bool is_mean = fit.rows.empty();
      for (const TableValue& cell :
           std::vector<TableValue>{or_undefined(p.name == "coefficient" ? fit.unit : ""), fit.low, fit.high,
                                   std::int64_t{fit.n}, is_mean ? TableValue() : TableValue(fit.law.rms),
                                   is_mean ? TableValue() : TableValue(fit.law.pattern.is_systematic())})
        row.push_back(cell);
      table.rows.push_back(std::move(row));
    }
  return table;
}

Json as_json(const ModulusFit& fit) {
  Json object;
  object["sample"] = fit.sample;
  object["modulus"] = fit.modulus;
  object["against"] = word_of(fit.against);
  object["refusal"] = fit.law.found() ? Json(nullptr) : Json(fit.law.failure_reason);
  object["unit"] = fit.unit.empty() ? Json(nullptr) : Json(fit.unit);
  object["rows_used"] = fit.rows;
  object["window"] = Json{fit.low, fit.high};
  object["n_points"] = fit.n;
  object["parameters"] = parameters_as_json(fit.law.parameters);
  object["rms"] = fit.law.found() && !fit.rows.empty() ? Json(fit.law.rms) : Json(nullptr);
  object["residual_pattern"] = pattern_as_json(fit.law.pattern);
  object["warnings"] = fit.law.warnings;
  return object;
}

}  // namespace floc
