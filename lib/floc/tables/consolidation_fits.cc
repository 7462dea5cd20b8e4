#include "floc/tables/consolidation_fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/base/error.h"
#include "floc/base/infinity.h"
#include "floc/base/parse_number.h"
#include "floc/fitting/supported_law.h"

namespace floc {
namespace {

/// Kinds of steps that are left out. Each description continues a message that begins with "N row(s)".
constexpr LeftOutStep kLeftOut[] = {
    {PathStep::zero_pressure, "zero_pressure", "at P* = 0"},
    {PathStep::unloading, "unloading", "of unloading"},
    {PathStep::reloading, "reloading", "of reloading"},
    {PathStep::later_virgin, "later_virgin",
     "of later loading beyond the largest earlier pressure (--loading virgin includes them)"},
    {PathStep::hold, "hold", "at constant pressure"},
    {PathStep::test, "test", "of tests with a driven axis"},
    {PathStep::first_loading, "before_loading", "before the branch \"load\""},
};

/// Applies the option --P0: the fitted window begins at the pressure of the curve that is nearest to P0, and ends at
/// the last pressure. Does nothing if P0 is not positive.
void start_at_P0(double P0, const ConsolidationCurve& curve, ConsolidationOptions& options) {
  if (P0 <= 0.0 || curve.P_star.empty()) return;
  const auto distance = [P0](double P) { return std::abs(std::log(P / P0)); };
  const double nearest = *std::min_element(curve.P_star.begin(), curve.P_star.end(),
                                           [&](double a, double b) { return distance(a) < distance(b); });
  options.window = {nearest, curve.P_star.back()};
}

const char* word_for(ConsolidationLaw law) {
  switch (law) {
    case ConsolidationLaw::log:
      return "log";
    case ConsolidationLaw::power:
      return "power";
    case ConsolidationLaw::full:
      return "full";
  }
  return "";
}

const char* word_for(Weighting weighting) {
  switch (weighting) {
    case Weighting::uniform:
      return "uniform";
    case Weighting::scatter:
      return "scatter";
    case Weighting::between:
      return "between";
    default:
      return "relative";
  }
}

/// Returns the change from one regime of consolidation to the next as a json object: the two successive pressures of
/// the curve between which the change lies, the probability that it lies there, and the ends of a 95 % interval.
Json change_as_json(const std::optional<ChangePoint>& change, const ConsolidationCurve& curve) {
  if (!change) return nullptr;
  const auto pressure = [&](int i) {
    return i < 0 || i >= static_cast<int>(curve.P_star.size())
               ? Json(nullptr)
               : Json(curve.P_star[static_cast<std::size_t>(i)]);
  };
  return {{"after", pressure(change->first - 1)},
          {"before", pressure(change->first)},
          {"low95", pressure(change->low95 - 1)},
          {"high95", pressure(change->high95)},
          {"probability", change->places.empty() ? Json(nullptr) : Json(change->places.front().probability)}};
}

/// Returns the numbers of the table rows that contain the points `first` to `end - 1` of a sample. For the mean of
/// several tables, which has no rows, returns the indices of the points.
Json rows_of(const ConsolidationSample& sample, int first, int end) {
  Json rows = Json::array();
  for (int i = first; i < end; ++i)
    rows.push_back(sample.loading.rows.empty() ? i : sample.loading.rows[static_cast<std::size_t>(i)]);
  return rows;
}

Json regimes_as_json(const ConsolidationSample& sample, const ConsolidationFit& fit) {
  if (!fit.regimes) return nullptr;
  const Regimes& r = *fit.regimes;
  const auto n = static_cast<int>(sample.loading.curve.phi.size());
  return {{"plateau_end", change_as_json(r.plateau_end, sample.loading.curve)},
          {"onset_of_III", change_as_json(r.onset_three, sample.loading.curve)},
          {"rows_I", rows_of(sample, 0, r.n_plateau)},
          {"rows_II", rows_of(sample, r.n_plateau, r.end_of_two)},
          {"rows_III", rows_of(sample, r.end_of_two, n)},
          {"jump_distance",
           fit.law == ConsolidationLaw::log && r.jump_distance > 0.0 ? Json(r.jump_distance) : Json(nullptr)},
          {"n_lagging", fit.law == ConsolidationLaw::log ? r.n_lagging : 0}};
}

/// Returns the cells in the columns window_low and window_high for a parameter. For parameters other than lambda and
/// C_c, these cells are empty.
std::vector<TableValue> cells_of_range(const FittedParameter& p, const ConsolidationFit& fit) {
  const double unit = p.name == "C_c" ? std::numbers::ln10 : 1.0;
  const auto range = p.name == "lambda" || p.name == "C_c" ? range_of_lambda(fit) : std::nullopt;
  if (!range) return {TableValue(), TableValue()};
  return {TableValue(unit * range->first), TableValue(unit * range->second)};
}

}  // namespace

std::span<const LeftOutStep> left_out_steps() {
  return kLeftOut;
}

std::vector<std::vector<double>> ConsolidationSample::loops() const {
  std::vector<std::vector<double>> points;
  const std::vector<double> gap = {std::nan(""), std::nan("")};
  const auto add = [&](std::size_t i) { points.push_back({path[i].P_star, 1.0 / path[i].phi}); };
  bool inside = false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool is_loop = steps[i] == PathStep::unloading || steps[i] == PathStep::reloading;
    // A loop begins with the last row before the pressure falls.
    if (is_loop && !inside) add(i - 1);
    if (is_loop) add(i);
    if (!is_loop && inside) points.push_back(gap);
    inside = is_loop;
  }
  return points;
}

std::vector<int> left_out(const ConsolidationSample& sample, PathStep step) {
  const std::vector<int>& kept = sample.loading.rows;
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(sample.steps.size()); ++i)
    if (sample.steps[static_cast<std::size_t>(i)] == step &&
        std::find(kept.begin(), kept.end(), i) == kept.end())
      rows.push_back(i);
  return rows;
}

ConsolidationSample consolidation_sample(const PathTable& path, const ConsolidationFitOptions& asked) {
  const bool virgin = asked.loading.empty() ? asked.chooses_law() : asked.loading == "virgin";
  return {path.name, first_loading(path.rows, virgin), path_steps(path.rows), path.unit, path.stress,
          path.rows};
}

double phi_limit_of(const std::string& text) {
  if (text == "none") return kInfinity;
  const auto limit = parse_number<double>(text);
  if (!limit || *limit <= 0.0)
    throw InputError("--phi-limit", fmt::format("\"{}\": expected a positive solid fraction, or none", text));
  return *limit;
}

ConsolidationOptions consolidation_options(const ConsolidationFitOptions& asked) {
  ConsolidationOptions options;
  options.law = asked.law == "log"     ? ConsolidationLaw::log
                : asked.law == "power" ? ConsolidationLaw::power
                                       : ConsolidationLaw::full;
  if (!asked.window.empty()) {
    options.window = {asked.window[0], asked.window[1]};
    if (!(0 < options.window->first && options.window->first < options.window->second))
      throw InputError("--window", fmt::format("{},{}: expected two positive pressures P*, the lower one first",
                                               asked.window[0], asked.window[1]));
  }
  options.hold_P0 = asked.protocol == "published";
  if (options.hold_P0 && options.law != ConsolidationLaw::full)
    throw InputError("--protocol published",
                     "this protocol fits the full law: use --law full or leave out --law");
  options.weighting = asked.weights == "uniform"    ? Weighting::uniform
                      : asked.weights == "relative" ? Weighting::relative
                                                    : Weighting::automatic;
  options.loss = asked.loss == "huber" ? Loss::huber : asked.loss == "cauchy" ? Loss::cauchy : Loss::squared;
  options.phi_limit = asked.phi_limit;
  options.n_bootstrap = asked.n_bootstrap;
  options.seed = asked.seed;
  return options;
}

std::vector<ConsolidationSample> with_pooled(std::vector<ConsolidationSample> samples, bool only_pooled) {
  if (samples.size() < 2) return samples;
  std::vector<ConsolidationCurve> curves;
  for (const ConsolidationSample& s : samples) curves.push_back(s.loading.curve);
  ConsolidationSample pooled{
      "pooled", {mean_curve(curves), {}}, {}, samples.front().unit, samples.front().stress};
  if (only_pooled) return {pooled};
  samples.push_back(std::move(pooled));
  return samples;
}

ConsolidationFit fit_of(const ConsolidationSample& sample, const ConsolidationFitOptions& asked,
                        const ConsolidationOptions& options) {
  ConsolidationOptions own = options;
  // The keyword "scatter" asks for weights from the scatter between samples. A single curve has no such scatter, so its
  // fit keeps the weighting of `options`.
  if (asked.weights == "scatter" && sample.loading.curve.samples.cols() > 1) own.weighting = Weighting::scatter;
  start_at_P0(asked.P0, sample.loading.curve, own);
  if (asked.chooses_law()) return fit_supported_law(sample.loading.curve, own);
  return fit_consolidation(sample.loading.curve, own);
}

ConsolidationFit consolidation_fit(const std::vector<std::string>& inputs, const ConsolidationFitOptions& asked,
                                   const ColumnNames& columns) {
  const ConsolidationOptions options = consolidation_options(asked);
  const OedometerPressure stress = asked.stress == "mean" ? OedometerPressure::mean : OedometerPressure::driven;
  std::vector<PathTable> paths;
  for (const std::string& input : inputs)
    for (const std::string& table : tables_of(input)) {
      paths.push_back(read_path(table, columns, {"P_star"}, stress, asked.phi_limit));
      // The mean over the paths needs one unit of pressure. All paths are converted to the unit of the first path.
      convert_pressures(paths.front(), paths.back());
    }
  std::vector<ConsolidationSample> samples;
  for (const PathTable& path : paths) samples.push_back(consolidation_sample(path, asked));
  if (samples.empty())
    throw InputError("fit",
                     "no table of a load path is given: give one or more tables, or directories of floc run");
  // The last sample is the mean of all samples. If there is only one table, the last sample is the sample of this
  // table.
  return fit_of(with_pooled(std::move(samples), options.hold_P0).back(), asked, options);
}

std::optional<std::pair<double, double>> range_of_lambda(const ConsolidationFit& fit) {
  const FittedParameter* lambda = fit.found() ? fit.find("lambda") : nullptr;
  if (!lambda || !lambda->value || fit.window_shifts.empty()) return std::nullopt;
  std::pair<double, double> range{*lambda->value, *lambda->value};
  for (const WindowShift& shift : fit.window_shifts) {
    // It is not known how far a window without a value of lambda would extend the range, so no range is returned.
    if (!shift.lambda) return std::nullopt;
    range = {std::min(range.first, *shift.lambda), std::max(range.second, *shift.lambda)};
  }
  return range;
}

const char* limit_of(const ErrorParts& parts, const ConsolidationFit& fit) {
  if (parts.regimes > parts.scatter) return "regimes";
  return fit.errors_from_samples ? "samples" : "points";
}

Json as_json(const ConsolidationSample& sample, const ConsolidationFit& fit,
             const ConsolidationFitOptions& asked) {
  Json object;
  object["sample"] = sample.name;
  object["law"] = word_for(fit.law);
  object["protocol"] = asked.protocol.empty() ? "automatic" : asked.protocol;
  // Every object has all keys, so that scripts need not test whether a key exists. A member without a value is null or
  // empty.
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.failure_reason);
  object["window"] = fit.found() ? Json{fit.window_low, fit.window_high} : Json(nullptr);
  object["pressure_unit"] = sample.unit.empty() ? Json(nullptr) : Json(sample.unit);
  object["stress"] = sample.stress.empty() ? Json(nullptr) : Json(sample.stress);
  object["n_points"] = fit.used.size();
  object["n_plateau"] = fit.n_plateau;
  object["parameters"] = parameters_as_json(fit.parameters);
  object["correlation"] = Json::object();
  for (std::size_t i = 0; i < fit.correlated.size(); ++i)
    for (std::size_t j = 0; j < fit.correlated.size(); ++j)
      object["correlation"][fit.correlated[i]][fit.correlated[j]] = number_or_null(fit.correlation(i, j));
  object["rms"] = fit.found() ? Json(fit.rms) : Json(nullptr);
  // The pattern of the residuals is computed only if the standard errors are computed from the residuals.
  object["residual_pattern"] =
      fit.found() && !fit.errors_from_samples ? pattern_as_json(fit.pattern) : Json(nullptr);
  object["weights"] = word_for(fit.weighting);
  object["loss"] = asked.loss;
  object["errors_from"] = fit.errors_from_samples ? "samples" : "residuals";
  object["error_budget"] = Json::object();
  for (const ErrorParts& parts : fit.error_parts)
    object["error_budget"][parts.name] = {{"scatter", number_or_null(parts.scatter)},
                                          {"regimes", number_or_null(parts.regimes)},
                                          {"limited_by", limit_of(parts, fit)}};
  object["profiled"] = fit.profiled;
  object["bootstrap"] = asked.n_bootstrap > 0
                            ? Json{{"n", fit.n_bootstrapped}, {"parameters", parameters_as_json(fit.bootstrap)}}
                            : Json(nullptr);
  object["regimes"] = fit.found() ? regimes_as_json(sample, fit) : Json(nullptr);
  object["window_shifts"] = Json::array();
  for (const WindowShift& s : fit.window_shifts)
    object["window_shifts"].push_back({{"change", s.change}, {"lambda", number_or_null(s.lambda)}});
  const auto range = range_of_lambda(fit);
  object["lambda_range"] = range ? Json{range->first, range->second} : Json(nullptr);
  object["rows_used"] = Json::array();
  object["P_star_used"] = Json::array();
  // The mean of several samples has no table rows. The pressures P* identify its points.
  for (const int i : fit.used) {
    if (!sample.loading.rows.empty()) object["rows_used"].push_back(sample.loading.rows[i]);
    object["P_star_used"].push_back(sample.loading.curve.P_star[i]);
  }
  object["rows_left_out"] = Json::object();
  for (const LeftOutStep& s : kLeftOut)
    if (const std::vector<int> rows = left_out(sample, s.step); !rows.empty())
      object["rows_left_out"][s.key] = rows;
  object["warnings"] = fit.warnings;
  object["law_asked"] = asked.law;
  object["phi_limit"] = number_or_null(asked.phi_limit);
  return object;
}

Table consolidation_table(const ConsolidationFitOptions& asked) {
  Table table{{"sample", "law", "parameter", "value", "stderr", "low95", "high95", "identified", "unit",
               "P_star_low", "P_star_high", "n_points", "rms"},
              {}};
  if (asked.n_bootstrap > 0)
    for (const char* column : {"bootstrap_stderr", "bootstrap_low95", "bootstrap_high95"})
      table.columns.emplace_back(column);
  for (const char* column : {"stress", "window_low", "window_high", "systematic"})
    table.columns.emplace_back(column);
  return table;
}

void add_rows(const ConsolidationSample& sample, const ConsolidationFit& fit,
              const ConsolidationFitOptions& asked, Table& table) {
  const auto bootstrapped = [&](const std::string& name) -> std::optional<FittedParameter> {
    for (const FittedParameter& p : fit.bootstrap)
      if (p.name == name) return p;
    return std::nullopt;
  };
  for (const FittedParameter& p : fit.parameters) {
    std::vector<TableValue> row = {sample.name, word_for(fit.law), p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    const bool is_pressure = p.name == "P0_star" || p.name == "P1_star";
    row.push_back(is_pressure && !sample.unit.empty() ? TableValue(sample.unit) : TableValue());
    for (const TableValue& cell : std::vector<TableValue>{fit.window_low, fit.window_high,
                                                          static_cast<std::int64_t>(fit.used.size()), fit.rms})
      row.push_back(cell);
    if (asked.n_bootstrap > 0) {
      const auto b = bootstrapped(p.name);
      row.push_back(b ? or_undefined(b->standard_error) : TableValue());
      row.push_back(b ? or_undefined(b->low95) : TableValue());
      row.push_back(b ? or_undefined(b->high95) : TableValue());
    }
    row.push_back(or_undefined(sample.stress));
    for (TableValue& cell : cells_of_range(p, fit)) row.push_back(std::move(cell));
    row.emplace_back();
    if (!fit.errors_from_samples) row.back() = fit.pattern.is_systematic();
    table.rows.push_back(std::move(row));
  }
}

}  // namespace floc
