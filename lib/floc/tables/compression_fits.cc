#include "floc/tables/compression_fits.h"

#include <algorithm>

#include "floc/base/infinity.h"

namespace floc {
namespace {

/// Returns the first and the last of the fitted pressures.
std::pair<double, double> window_of(const CompressedPath& compressed, const CompressionFit& fit) {
  const std::vector<double>& P = compressed.loading.curve.P_star;
  return {P[static_cast<std::size_t>(fit.first)], P[static_cast<std::size_t>(fit.first + fit.n_points - 1)]};
}

/// Returns the unit of a parameter, formed from the unit of the pressures; empty for a pure number.
std::string unit_of(const std::string& parameter, const std::string& unit) {
  if (unit.empty()) return "";
  if (parameter == "b") return "1/" + unit;
  for (const char* pressure : {"P_y", "k1", "k2", "tau"})
    if (parameter == pressure) return unit;
  return "";
}

}  // namespace

const char* name_of(CompressionLaw law) {
  return std::find_if(compression_laws().begin(), compression_laws().end(),
                      [law](const NamedCompressionLaw& named) { return named.law == law; })
      ->name;
}

double CompressionFitOptions::phi_limit() const {
  return density == "in-die" ? kInfinity : fit.phi_limit;
}

CompressedPath compression_fits(const PathTable& path, const CompressionFitOptions& asked) {
  CompressedPath compressed{first_loading(path.rows), {}};
  std::vector<CompressionLaw> laws;
  for (const NamedCompressionLaw& named : compression_laws())
    if (asked.law == "all" || asked.law == named.name) laws.push_back(named.law);
  CompressionOptions options = asked.fit;
  options.phi_limit = asked.phi_limit();
  compressed.fits =
      fit_compression(compressed.loading.curve.P_star, compressed.loading.curve.phi, laws, options);
  std::stable_sort(compressed.fits.begin(), compressed.fits.end(),
                   [](const CompressionFit& a, const CompressionFit& b) {
                     return a.found() && (!b.found() || a.aicc < b.aicc);
                   });
  return compressed;
}

Table compression_table() {
  return {{"sample", "law", "parameter", "value", "stderr", "low95", "high95", "identified", "unit",
           "delta_aicc", "akaike_weight", "systematic", "P_low", "P_high", "n_points", "rms", "stress"},
          {}};
}

void add_rows(const PathTable& path, const CompressedPath& compressed, Table& table) {
  for (const CompressionFit& fit : compressed.fits) {
    if (!fit.found()) continue;
    const auto [low, high] = window_of(compressed, fit);
    for (const FittedParameter& p : fit.parameters) {
      std::vector<TableValue> row = {path.name, name_of(fit.law), p.name};
      for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
      for (const TableValue& cell :
           std::vector<TableValue>{or_undefined(unit_of(p.name, path.unit)), fit.delta_aicc, fit.weight,
                                   fit.pattern.is_systematic(), low, high,
                                   static_cast<std::int64_t>(fit.n_points), fit.rms, path.stress_of_rows()})
        row.push_back(cell);
      table.rows.push_back(std::move(row));
    }
  }
}

Json as_json(const PathTable& path, const CompressedPath& compressed, const CompressionFit& fit,
             const CompressionFitOptions& asked) {
  Json object;
  object["sample"] = path.name;
  object["law"] = name_of(fit.law);
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.failure_reason);
  object["pressure_unit"] = path.unit.empty() ? Json(nullptr) : Json(path.unit);
  object["stress"] = path.stress.empty() ? Json(nullptr) : Json(path.stress);
  object["density"] = asked.density;
  object["n_points"] = fit.n_points;
  object["parameters"] = parameters_as_json(fit.parameters);
  object["window"] = nullptr;
  if (fit.found()) {
    const auto [low, high] = window_of(compressed, fit);
    object["window"] = {low, high};
  }
  for (const auto& [key, value] : {std::pair{"rms", fit.rms},
                                   {"aicc", fit.aicc},
                                   {"delta_aicc", fit.delta_aicc},
                                   {"akaike_weight", fit.weight}})
    object[key] = fit.found() ? number_or_null(value) : Json(nullptr);
  object["residual_pattern"] = pattern_as_json(fit.pattern);
  object["rows_used"] = Json::array();
  for (int i = fit.first; i < fit.first + fit.n_points; ++i)
    object["rows_used"].push_back(compressed.loading.rows[static_cast<std::size_t>(i)]);
  object["warnings"] = fit.warnings;
  return object;
}

}  // namespace floc
