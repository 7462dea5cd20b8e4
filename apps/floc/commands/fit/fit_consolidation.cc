#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

#include "commands/fit/fit_commands.h"
#include "commands/fit/fit_input.h"
#include "floc/tables/consolidation_fits.h"
#include "plots/fit_plot.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct ConsolidationArguments {
  std::vector<std::string> inputs;
  ConsolidationFitOptions fit;
  std::string columns;
  std::string plot;
  Printing printing;
};

/// Reads a sample and prints which of its rows are left out.
/// @param first  first table, to whose unit the pressures are converted; set by the first call
ConsolidationSample read_sample(const std::string& file, const ColumnNames& columns,
                                const ConsolidationArguments& arguments, std::optional<PathTable>& first) {
  PathTable path =
      read_path(file, columns, {"P_star"},
                arguments.fit.stress == "mean" ? OedometerPressure::mean : OedometerPressure::driven);
  log_notes(path);
  if (first) convert_pressures(*first, path);
  if (!first) first = path;
  ConsolidationSample sample = consolidation_sample(path, arguments.fit);
  std::vector<std::string> pieces;
  for (const LeftOutStep& s : left_out_steps())
    if (const std::vector<int> rows = left_out(sample, s.step); !rows.empty())
      pieces.push_back(fmt::format("{} row(s) {} ({})", rows.size(), s.description, ranges(rows)));
  if (!pieces.empty()) spdlog::info("{}: left out {}", sample.name, fmt::join(pieces, ", "));
  return sample;
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

/// Prints a fit and its warnings on stderr. @param n_asked  number of resampled fits in the options
void log_fit(const ConsolidationSample& sample, const ConsolidationFit& fit, int n_asked) {
  if (!fit.found()) {
    spdlog::warn("{}: no fit: {}", sample.name, fit.failure_reason);
    return;
  }
  std::vector<int> rows;
  // The mean of several samples has no rows of its own.
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
    // change_text() begins every piece with "; ", of which the first one is dropped.
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
    spdlog::info("{}: lambda with the window moved by one row: {}", sample.name, fmt::join(pieces, ", "));
  }
  if (n_asked > 0)
    spdlog::info("{}: bootstrap: {} of {} resampled fits have a regime II", sample.name, fit.n_bootstrapped,
                 n_asked);
  for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", sample.name, warning);
}

/// Warns if the mean of the samples leaves out pressures that not all of them have.
void warn_of_missing_pressures(const std::vector<ConsolidationSample>& read,
                               const std::vector<ConsolidationSample>& fitted) {
  if (read.size() < 2) return;
  const std::size_t n_common = fitted.back().loading.curve.phi.size();
  const std::size_t n_of_first = read.front().loading.curve.phi.size();
  if (n_common < n_of_first)
    spdlog::warn("pooled: {} of the {} pressures of {} are common to all {} samples", n_common, n_of_first,
                 read.front().name, read.size());
}

int fit_tables(const ConsolidationArguments& arguments) {
  const ConsolidationOptions options = consolidation_options(arguments.fit);
  Printing printing = arguments.printing;
  const ColumnNames columns =
      parse_column_names(arguments.columns, {"P_star", "phi", "void_ratio", "branch"}, printing);
  std::vector<ConsolidationSample> read;
  std::optional<PathTable> first;
  int code = for_each_table(arguments.inputs, [&](const std::string& file) {
    read.push_back(read_sample(file, columns, arguments, first));
    return static_cast<int>(kDone);
  });
  const std::vector<ConsolidationSample> samples = with_pooled(read, options.hold_P0);
  warn_of_missing_pressures(read, samples);
  Json array = Json::array();
  Table table = consolidation_table(arguments.fit);
  ConsolidationFit fit;
  for (const ConsolidationSample& sample : samples) {
    if (arguments.fit.weights == "scatter" && sample.loading.curve.samples.cols() < 2)
      spdlog::info("{}: a single curve has no scatter between samples: relative weights are used", sample.name);
    fit = fit_of(sample, arguments.fit, options);
    log_fit(sample, fit, arguments.fit.n_bootstrap);
    if (!fit.found()) code = worse(code, kNotConverged);
    array.push_back(as_json(sample, fit, arguments.fit));
    add_rows(sample, fit, arguments.fit, table);
  }
  // With several samples the last is their mean.
  if (!arguments.plot.empty() && !samples.empty() && fit.found())
    write_plot(arguments.plot, plot_of_fit({samples.back().name, samples.back().unit, samples.back().stress,
                                            samples.back().loading.curve, fit}));
  constexpr std::size_t kOfParameters = 8;
  print_fit(array, table, kOfParameters, printing);
  return code;
}

}  // namespace

Command add_fit_consolidation(CommandLine fit) {
  auto arguments = std::make_shared<ConsolidationArguments>();
  CommandLine app = fit.add_subcommand(
      "consolidation", "slope lambda of the virgin compression line and the other parameters of consolidation");
  app.add_option("TABLE", arguments->inputs,
                 "tables with columns P_star, phi (or void_ratio) and optionally branch; directories of `floc "
                 "run`; - is stdin")
      .required();
  app.add_option("--law", arguments->fit.law, "log (regime II), power (regime III) or full (both) [full]")
      .one_of({"log", "power", "full"});
  app.add_option("--window", arguments->fit.window,
                 "lo,hi: fit only the pressures P* in this window [found from the data]")
      .delimiter(',')
      .expected(2);
  app.add_option("--protocol", arguments->fit.protocol,
                 "published: hold P0* at a pressure of the curve and fit the mean of the samples [P0* is where "
                 "the plateau meets the line]")
      .one_of({"published"});
  // --P0 and --window both choose the pressures that are fitted.
  app.add_option("--P0", arguments->fit.P0,
                 "fit from the pressure nearest to this one to the last [found from the data]")
      .positive()
      .excludes("--window");
  app.add_option(
         "--loading", arguments->fit.loading,
         "first: the first loading; virgin: also later loadings beyond the largest pressure before [first]")
      .one_of({"first", "virgin"});
  app.add_option("--weights", arguments->fit.weights,
                 "uniform, relative (errors of 1/Phi are proportional to it) or scatter (between samples) "
                 "[scatter for a mean of three samples or more, otherwise relative]")
      .one_of({"uniform", "relative", "scatter"});
  app.add_option("--loss", arguments->fit.loss,
                 "loss function, which sets the weight of outliers: squared, huber or cauchy [squared]")
      .one_of({"squared", "huber", "cauchy"});
  app.add_option("--bootstrap", arguments->fit.n_bootstrap, "N: also give errors from N resampled fits [none]")
      .within(ConsolidationOptions::kBootstrap);
  app.add_option("--seed", arguments->fit.seed, "seed of the bootstrap [1]");
  app.add_option("--stress", arguments->fit.stress,
                 "stress from which P* of an oedometric test is computed: driven or mean [driven]")
      .one_of({"driven", "mean"});
  add_columns_option(app, arguments->columns, "P_star, phi, void_ratio, branch");
  app.add_option("--plot", arguments->plot,
                 "F.svg, F.pdf or F.png: curve, points, window and residuals; data and gnuplot script are "
                 "written beside it");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
