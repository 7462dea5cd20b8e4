#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "fit_commands.h"
#include "fit_parameters.h"
#include "fit_plot.h"
#include "fit_tables.h"
#include "floc/base/error.h"
#include "floc/fitting/consolidation.h"
#include "output.h"

namespace floc {
namespace {

struct Arguments {
  std::vector<std::string> inputs;
  std::string law = "full";
  std::string protocol;
  std::vector<double> window;
  double P0 = 0.0;
  std::string loading = "first";
  std::string weights;
  std::string loss = "squared";
  int n_bootstrap = 0;
  std::uint64_t seed = 1;
  std::string stress = "driven";
  std::string columns;
  std::string plot;
  std::string format;
};

/// A named curve with the rows of its table; a mean has none.
struct Sample {
  std::string name;
  Loading loading;
  std::vector<PathStep> steps;  ///< of all rows
  std::string unit;             ///< of the pressures
};

/// Rows that do `step` and are not fitted.
std::vector<int> left_out(const Sample& sample, PathStep step) {
  const std::vector<int>& kept = sample.loading.rows;
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(sample.steps.size()); ++i)
    if (sample.steps[static_cast<std::size_t>(i)] == step &&
        std::find(kept.begin(), kept.end(), i) == kept.end())
      rows.push_back(i);
  return rows;
}

struct StepName {
  PathStep step;
  const char *key, *description;
};
constexpr StepName kLeftOut[] = {
    {PathStep::zero_pressure, "zero_pressure", "at P* = 0"},
    {PathStep::unloading, "unloading", "of unloading"},
    {PathStep::reloading, "reloading", "of reloading"},
    {PathStep::later_virgin, "later_virgin", "of later loading beyond it (--loading virgin takes them)"},
    {PathStep::hold, "hold", "at a pressure that is held"},
    {PathStep::test, "test", "of tests with a driven axis"},
    {PathStep::first_loading, "before_loading", "before the branch \"load\""},
};

Sample read_sample(const std::string& file, const Arguments& arguments) {
  const PathTable path =
      read_path(file, parse_column_names(arguments.columns, {"P_star", "phi", "void_ratio", "branch"}),
                {"P_star"}, arguments.stress == "mean" ? OedometerPressure::mean : OedometerPressure::driven);
  const bool any_oedometer = std::any_of(path.rows.begin(), path.rows.end(),
                                         [](const PathRow& row) { return row.load == PathLoad::oedometric; });
  if (any_oedometer)
    spdlog::info("{}: P* of oedometric rows is that of the {} stress", path.name, arguments.stress);
  Sample sample{path.name, first_loading(path.rows, arguments.loading == "virgin"), path_steps(path.rows),
                path.unit};
  std::vector<std::string> pieces;
  for (const StepName& s : kLeftOut)
    if (const std::vector<int> rows = left_out(sample, s.step); !rows.empty())
      pieces.push_back(fmt::format("{} row(s) {} ({})", rows.size(), s.description, ranges(rows)));
  if (!pieces.empty()) spdlog::info("{}: left out {}", sample.name, fmt::join(pieces, ", "));
  return sample;
}

ConsolidationOptions options_of(const Arguments& arguments) {
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
Json rows_of(const Sample& sample, int first, int end) {
  Json rows = Json::array();
  for (int i = first; i < end; ++i)
    rows.push_back(sample.loading.rows.empty() ? i : sample.loading.rows[static_cast<std::size_t>(i)]);
  return rows;
}

Json regimes_as_json(const Sample& sample, const ConsolidationFit& fit) {
  if (!fit.regimes) return nullptr;
  const Regimes& r = *fit.regimes;
  const auto n = static_cast<int>(sample.loading.curve.phi.size());
  return {{"plateau_end", change_as_json(r.plateau_end, sample.loading.curve)},
          {"onset_of_III", change_as_json(r.onset_three, sample.loading.curve)},
          {"rows_I", rows_of(sample, 0, r.n_plateau)},
          {"rows_II", rows_of(sample, r.n_plateau, r.end_of_two)},
          {"rows_III", rows_of(sample, r.end_of_two, n)}};
}

/// What a smaller error would need: "samples", "points" on the curve, or a clearer end of the "regimes".
const char* limit_of(const ErrorParts& parts, const ConsolidationFit& fit) {
  if (parts.regimes > parts.scatter) return "regimes";
  return fit.errors_from_samples ? "samples" : "points";
}

Json as_json(const Sample& sample, const ConsolidationFit& fit, const Arguments& arguments) {
  Json object;
  object["sample"] = sample.name;
  object["law"] = arguments.law;
  object["protocol"] = arguments.protocol.empty() ? "automatic" : arguments.protocol;
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.refusal);
  object["window"] = fit.found() ? Json{fit.window_low, fit.window_high} : Json(nullptr);
  object["pressure_unit"] = sample.unit.empty() ? Json(nullptr) : Json(sample.unit);
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
  for (const StepName& s : kLeftOut)
    if (const std::vector<int> rows = left_out(sample, s.step); !rows.empty())
      object["rows_left_out"][s.key] = rows;
  object["warnings"] = fit.warnings;
  return object;
}

void add_table_rows(const Sample& sample, const ConsolidationFit& fit, const Arguments& arguments,
                    Table& table) {
  const auto bootstrapped = [&](const std::string& name) -> std::optional<FittedParameter> {
    for (const FittedParameter& p : fit.bootstrap)
      if (p.name == name) return p;
    return std::nullopt;
  };
  for (const FittedParameter& p : fit.parameters) {
    std::vector<TableValue> row = {sample.name, arguments.law, p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    const bool is_pressure = p.name == "P0_star" || p.name == "P1_star";
    row.push_back(is_pressure && !sample.unit.empty() ? TableValue(sample.unit) : TableValue());
    for (const TableValue& cell : std::vector<TableValue>{fit.window_low, fit.window_high,
                                                          static_cast<std::int64_t>(fit.used.size()), fit.rms})
      row.push_back(cell);
    if (arguments.n_bootstrap > 0) {
      const auto b = bootstrapped(p.name);
      row.push_back(b ? TableValue(*b->standard_error) : TableValue());
      row.push_back(b ? TableValue(*b->low95) : TableValue());
      row.push_back(b ? TableValue(*b->high95) : TableValue());
    }
    table.rows.push_back(std::move(row));
  }
}

std::string change_text(const std::optional<ChangePoint>& change, const ConsolidationCurve& curve,
                        const char* what) {
  if (!change || change->first == 0) return "";
  const auto& P = curve.P_star;
  const auto at = [&](int i) {
    return P[static_cast<std::size_t>(std::clamp(i, 0, static_cast<int>(P.size()) - 1))];
  };
  return fmt::format("; {} between P* = {:.4g} and {:.4g} (95 %: {:.4g} to {:.4g})", what,
                     at(change->first - 1), at(change->first), at(change->low95 - 1), at(change->high95));
}

/// @param n_asked  resampled fits asked for
void log_fit(const Sample& sample, const ConsolidationFit& fit, int n_asked) {
  if (!fit.found()) {
    spdlog::warn("{}: no fit: {}", sample.name, fit.refusal);
    return;
  }
  std::vector<int> rows;
  for (const int i : fit.used)
    if (!sample.loading.rows.empty()) rows.push_back(sample.loading.rows[i]);
  spdlog::info(
      "{}: fitted {} pressures, P* = {:.6g} to {:.6g}{}{}; r.m.s. residual of 1/Phi {:.3g}; errors from {}",
      sample.name, fit.used.size(), fit.window_low, fit.window_high,
      rows.empty() ? "" : ", rows " + ranges(rows),
      fit.n_plateau > 0 ? fmt::format("; the {} before them are the plateau of regime I", fit.n_plateau) : "",
      fit.rms, fit.errors_from_samples ? "the scatter between samples" : "the residuals");
  if (fit.regimes) {
    const std::string pieces =
        change_text(fit.regimes->plateau_end, sample.loading.curve, "the plateau ends") +
        change_text(fit.regimes->onset_three, sample.loading.curve, "regime III sets in");
    if (!pieces.empty()) spdlog::info("{}: {}", sample.name, pieces.substr(2));
  }
  std::vector<std::string> budget;
  for (const ErrorParts& parts : fit.error_parts)
    budget.push_back(fmt::format("{} {:.2g} and {:.2g} ({})", parts.name, parts.scatter, parts.regimes,
                                 limit_of(parts, fit)));
  if (!budget.empty())
    spdlog::info("{}: errors from {} and from where the regimes end (what limits): {}", sample.name,
                 fit.errors_from_samples ? "the scatter between samples" : "the residuals",
                 fmt::join(budget, ", "));
  if (!fit.window_shifts.empty()) {
    std::vector<std::string> pieces;
    for (const WindowShift& s : fit.window_shifts)
      pieces.push_back(fmt::format("{} ({})", s.lambda ? fmt::format("{:.4g}", *s.lambda) : "none", s.change));
    spdlog::info("{}: lambda with the window moved by a row: {}", sample.name, fmt::join(pieces, ", "));
  }
  if (n_asked > 0)
    spdlog::info("{}: bootstrap: {} of {} resampled fits have a regime II", sample.name, fit.n_bootstrapped,
                 n_asked);
  for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", sample.name, warning);
}

/// What is fitted: each sample and their mean; the published protocol fits the mean alone.
std::vector<Sample> with_pooled(std::vector<Sample> samples, bool only_pooled) {
  if (samples.size() < 2) return samples;
  std::vector<ConsolidationCurve> curves;
  for (const Sample& s : samples) curves.push_back(s.loading.curve);
  Sample pooled{"pooled", {mean_curve(curves), {}}, {}, samples.front().unit};
  if (pooled.loading.curve.phi.size() < curves.front().phi.size())
    spdlog::warn("pooled: {} of the {} pressures of {} are common to all {} samples",
                 pooled.loading.curve.phi.size(), curves.front().phi.size(), samples.front().name,
                 samples.size());
  if (only_pooled) return {pooled};
  samples.push_back(std::move(pooled));
  return samples;
}

int fit_tables(const Arguments& arguments) {
  const ConsolidationOptions options = options_of(arguments);
  std::vector<Sample> read;
  int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    read.push_back(read_sample(file, arguments));
    return static_cast<int>(kDone);
  });
  const std::vector<Sample> samples = with_pooled(std::move(read), options.hold_P0);
  Json array = Json::array();
  Table table{{"sample", "law", "parameter", "value", "stderr", "low95", "high95", "identified", "unit",
               "P_star_low", "P_star_high", "n_points", "rms"},
              {}};
  if (arguments.n_bootstrap > 0)
    for (const char* column : {"bootstrap_stderr", "bootstrap_low95", "bootstrap_high95"})
      table.columns.emplace_back(column);
  ConsolidationFit fit;
  for (const Sample& sample : samples) {
    ConsolidationOptions own = options;
    if (arguments.weights == "scatter" && sample.loading.curve.samples.cols() < 2)
      spdlog::info("{}: a single curve has no scatter between samples: relative weights", sample.name);
    if (arguments.weights == "scatter" && sample.loading.curve.samples.cols() > 1)
      own.weighting = Weighting::scatter;
    start_at_P0(arguments.P0, sample.loading.curve, own);
    fit = fit_consolidation(sample.loading.curve, own);
    log_fit(sample, fit, arguments.n_bootstrap);
    if (!fit.found()) code = worse(code, kNotConverged);
    array.push_back(as_json(sample, fit, arguments));
    add_table_rows(sample, fit, arguments, table);
  }
  // With several samples the last is their mean.
  if (!arguments.plot.empty() && !samples.empty() && fit.found())
    write_plot(arguments.plot,
               plot_of_fit({samples.back().name, samples.back().unit, samples.back().loading.curve, fit}));
  constexpr std::size_t kOfParameters = 8;
  print_fit(array, table, kOfParameters, arguments.format);
  return code;
}

}  // namespace

Command add_fit_consolidation(CommandLine fit) {
  auto arguments = std::make_shared<Arguments>();
  CommandLine app =
      fit.add_subcommand("consolidation", "plasticity index lambda and the other parameters of consolidation");
  app.add_option(
         "TABLE", arguments->inputs,
         "tables with columns P_star, phi (or void_ratio) and perhaps branch; directories of `floc run`; "
         "- is stdin")
      .required();
  app.add_option("--law", arguments->law, "log (regime II), power (regime III) or full (both) [full]")
      .one_of({"log", "power", "full"});
  app.add_option("--window", arguments->window, "lo,hi: fit on these P* only [found]")
      .delimiter(',')
      .expected(2);
  app.add_option("--protocol", arguments->protocol,
                 "published: P0* on the grid and held, the mean of the samples fitted [where the plateau meets "
                 "the line]")
      .one_of({"published"});
  app.add_option("--P0", arguments->P0, "fit from the pressure nearest to this one to the last [found]")
      .positive()
      .excludes("--window");
  app.add_option("--loading", arguments->loading,
                 "first, or virgin: also what later loadings add beyond the largest pressure before [first]")
      .one_of({"first", "virgin"});
  app.add_option("--weights", arguments->weights,
                 "uniform, relative (errors of 1/Phi are proportional to it) or scatter (between samples) "
                 "[scatter for a mean of three samples or more, otherwise relative]")
      .one_of({"uniform", "relative", "scatter"});
  app.add_option("--loss", arguments->loss, "squared, huber or cauchy: what outliers count for [squared]")
      .one_of({"squared", "huber", "cauchy"});
  app.add_option("--bootstrap", arguments->n_bootstrap, "N: errors of N resampled fits beside [none]")
      .between(2, 1000000);
  app.add_option("--seed", arguments->seed, "of the bootstrap [1]");
  app.add_option("--stress", arguments->stress,
                 "driven or mean: the stress that P* is of in an oedometer [driven]")
      .one_of({"driven", "mean"});
  add_columns_option(app, arguments->columns, "P_star, phi, void_ratio, branch");
  app.add_option("--plot", arguments->plot,
                 "F.svg, F.pdf or F.png: curve, points, window and residuals; data and gnuplot script are "
                 "written beside it");
  add_format_option(app, arguments->format);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
