#include "consolidation_fits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"

namespace floc {
namespace {

constexpr LeftOutStep kLeftOut[] = {
    {PathStep::zero_pressure, "zero_pressure", "at P* = 0"},
    {PathStep::unloading, "unloading", "of unloading"},
    {PathStep::reloading, "reloading", "of reloading"},
    {PathStep::later_virgin, "later_virgin",
     "of later loading beyond the largest pressure before (--loading virgin includes them)"},
    {PathStep::hold, "hold", "at constant pressure"},
    {PathStep::test, "test", "of tests with a driven axis"},
    {PathStep::first_loading, "before_loading", "before the branch \"load\""},
};

/// --P0 X: the window starts at the pressure of the curve that is nearest to X.
void start_at_P0(double P0, const ConsolidationCurve& curve, ConsolidationOptions& options) {
  if (P0 <= 0.0 || curve.P_star.empty()) return;
  const auto distance = [P0](double P) { return std::abs(std::log(P / P0)); };
  const double nearest = *std::min_element(curve.P_star.begin(), curve.P_star.end(),
                                           [&](double a, double b) { return distance(a) < distance(b); });
  options.window = {nearest, curve.P_star.back()};
}

const char* word_for(Weighting weighting) {
  switch (weighting) {
    case Weighting::uniform:
      return "uniform";
    case Weighting::scatter:
      return "scatter";
    default:
      return "relative";
  }
}

/// Pressures between which a change lies, and over which its probable places range.
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

/// Table rows (of a mean: indices of its pressures) of points first to end.
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
          {"rows_III", rows_of(sample, r.end_of_two, n)}};
}

}  // namespace

std::span<const LeftOutStep> left_out_steps() {
  return kLeftOut;
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

ConsolidationSample consolidation_sample(const PathTable& path, const ConsolidationArguments& arguments) {
  return {path.name, first_loading(path.rows, arguments.loading == "virgin"), path_steps(path.rows), path.unit,
          path.stress};
}

ConsolidationOptions consolidation_options(const ConsolidationArguments& arguments) {
  ConsolidationOptions options;
  options.law = arguments.law == "log"     ? ConsolidationLaw::log
                : arguments.law == "power" ? ConsolidationLaw::power
                                           : ConsolidationLaw::full;
  if (!arguments.window.empty()) {
    options.window = {arguments.window[0], arguments.window[1]};
    if (!(0 < options.window->first && options.window->first < options.window->second))
      throw InputError("--window", fmt::format("{},{}: expected two positive pressures P*, the lower one first",
                                               arguments.window[0], arguments.window[1]));
  }
  options.hold_P0 = arguments.protocol == "published";
  if (options.hold_P0 && options.law != ConsolidationLaw::full)
    throw InputError("--protocol published", "fits the full law; expected --law full, or no --law");
  options.weighting = arguments.weights == "uniform"    ? Weighting::uniform
                      : arguments.weights == "relative" ? Weighting::relative
                                                        : Weighting::automatic;
  options.loss = arguments.loss == "huber"    ? Loss::huber
                 : arguments.loss == "cauchy" ? Loss::cauchy
                                              : Loss::squared;
  options.n_bootstrap = arguments.n_bootstrap;
  options.seed = arguments.seed;
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

ConsolidationFit fit_of(const ConsolidationSample& sample, const ConsolidationArguments& arguments,
                        const ConsolidationOptions& options) {
  ConsolidationOptions own = options;
  if (arguments.weights == "scatter" && sample.loading.curve.samples.cols() > 1)
    own.weighting = Weighting::scatter;
  start_at_P0(arguments.P0, sample.loading.curve, own);
  return fit_consolidation(sample.loading.curve, own);
}

const char* limit_of(const ErrorParts& parts, const ConsolidationFit& fit) {
  if (parts.regimes > parts.scatter) return "regimes";
  return fit.errors_from_samples ? "samples" : "points";
}

Json as_json(const ConsolidationSample& sample, const ConsolidationFit& fit,
             const ConsolidationArguments& arguments) {
  Json object;
  object["sample"] = sample.name;
  object["law"] = arguments.law;
  object["protocol"] = arguments.protocol.empty() ? "automatic" : arguments.protocol;
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.refusal);
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
  object["weights"] = word_for(fit.weighting);
  object["loss"] = arguments.loss;
  object["errors_from"] = fit.errors_from_samples ? "samples" : "residuals";
  object["error_budget"] = Json::object();
  for (const ErrorParts& parts : fit.error_parts)
    object["error_budget"][parts.name] = {{"scatter", number_or_null(parts.scatter)},
                                          {"regimes", number_or_null(parts.regimes)},
                                          {"limited_by", limit_of(parts, fit)}};
  object["profiled"] = fit.profiled;
  object["bootstrap"] = arguments.n_bootstrap > 0
                            ? Json{{"n", fit.n_bootstrapped}, {"parameters", parameters_as_json(fit.bootstrap)}}
                            : Json(nullptr);
  object["regimes"] = fit.found() ? regimes_as_json(sample, fit) : Json(nullptr);
  object["window_shifts"] = Json::array();
  for (const WindowShift& s : fit.window_shifts)
    object["window_shifts"].push_back({{"change", s.change}, {"lambda", number_or_null(s.lambda)}});
  object["rows_used"] = Json::array();
  object["P_star_used"] = Json::array();
  for (const int i : fit.used) {
    if (!sample.loading.rows.empty()) object["rows_used"].push_back(sample.loading.rows[i]);
    object["P_star_used"].push_back(sample.loading.curve.P_star[i]);
  }
  object["rows_left_out"] = Json::object();
  for (const LeftOutStep& s : kLeftOut)
    if (const std::vector<int> rows = left_out(sample, s.step); !rows.empty())
      object["rows_left_out"][s.key] = rows;
  object["warnings"] = fit.warnings;
  return object;
}

}  // namespace floc
