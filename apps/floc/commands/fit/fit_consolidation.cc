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
  std::string phi_limit = "1";
  std::string plot;
  Printing printing;
};

/// Reads the load path of a sample from a table. Prints on stderr which rows are not fitted, and why.
/// @param columns  headers of the columns to read, for columns that do not have the usual names
/// @param first    table of the first sample, which the first call sets; the pressures of all later samples are
/// converted to the unit of this table
ConsolidationSample read_sample(const std::string& file, const ColumnNames& columns,
                                const ConsolidationArguments& arguments, std::optional<PathTable>& first) {
  PathTable path =
      read_path(file, columns, {"P_star"},
                arguments.fit.stress == "mean" ? OedometerPressure::mean : OedometerPressure::driven,
                arguments.fit.phi_limit);
  log_notes(path);
  if (first) convert_pressures(*first, path);
  if (!first) first = path;
  ConsolidationSample sample = consolidation_sample(path, arguments.fit);
  std::vector<std::string> pieces;
  for (const LeftOutStep& s : left_out_steps())
    if (const std::vector<int> rows = left_out(sample, s.step); !rows.empty())
      pieces.push_back(fmt::format("{} row(s) {} (row numbers {})", rows.size(), s.description, ranges(rows)));
  if (!pieces.empty()) spdlog::info("{}: rows that are not fitted: {}", sample.name, fmt::join(pieces, ", "));
  return sample;
}

std::string change_text(const std::optional<ChangePoint>& change, const ConsolidationCurve& curve,
                        const char* what) {
  if (!change || change->first == 0) return "";
  const auto& P = curve.P_star;
  const auto at = [&](int i) {
    return P[static_cast<std::size_t>(std::clamp(i, 0, static_cast<int>(P.size()) - 1))];
  };
  return fmt::format("; {} between P* = {:.4g} and {:.4g} (95 % interval {:.4g} to {:.4g})", what,
                     at(change->first - 1), at(change->first), at(change->low95 - 1), at(change->high95));
}

/// Returns whether the points before regime II lie on a recompression line with a significant slope, and not on
/// a plateau.
bool is_recompressed(const ConsolidationFit& fit) {
  const FittedParameter* kappa = fit.find("kappa");
  return kappa && kappa->low95.value_or(0.0) > 0.0;
}

/// Returns a parameter with its 95 % interval as text; empty if the fit has no value for this parameter.
std::string quoted(const ConsolidationFit& fit, const char* name, const char* symbol) {
  const FittedParameter* p = fit.find(name);
  if (!p || !p->value) return "";
  const std::string text = fmt::format("{} = {:.4g}", symbol, *p->value);
  return p->low95 && p->high95 ? text + fmt::format(" ({:.4g} to {:.4g})", *p->low95, *p->high95) : text;
}

/// Returns the main results of a fit as text: the slopes, the yield pressure, the window, and the smallest and largest
/// lambda of fits whose window is shifted by one row.
std::string headline(const ConsolidationFit& fit) {
  std::vector<std::string> parts;
  const bool yields = fit.n_plateau > 0;
  for (const auto& [name, symbol] : {std::pair{"lambda", "lambda"},
                                     {"kappa", "kappa"},
                                     {"C_c", "C_c"},
                                     {"C_s", "C_s"},
                                     {yields ? "P0_star" : "", "yield pressure P0*"},
                                     {"Phi_max", "Phi_max"}})
    if (std::string text = quoted(fit, name, symbol); !text.empty()) parts.push_back(std::move(text));
  parts.push_back(fmt::format("window {:.6g} to {:.6g}", fit.window_low, fit.window_high));
  if (const auto range = range_of_lambda(fit))
    parts.push_back(
        fmt::format("lambda {:.4g} to {:.4g} if the window moves by a row", range->first, range->second));
  return fmt::format("{}", fmt::join(parts, ", "));
}

const char* law_in_words(const ConsolidationFit& fit) {
  switch (fit.law) {
    case ConsolidationLaw::log:
      return "log law (the line of regime II)";
    case ConsolidationLaw::power:
      return "power law (regime III)";
    case ConsolidationLaw::full:
      return "full law (regimes II and III)";
  }
  return "";
}

/// Prints on stderr a summary of a fit and the warnings about it.
/// @param n_asked  number of resampled fits (option --bootstrap); 0 without bootstrap
void log_fit(const ConsolidationSample& sample, const ConsolidationFit& fit, int n_asked) {
  if (!fit.found()) {
    spdlog::warn("{}: the consolidation law cannot be fitted: {}", sample.name, fit.failure_reason);
    return;
  }
  spdlog::info("{}: {}, with 95 % intervals: {}", sample.name, law_in_words(fit), headline(fit));
  std::vector<int> rows;
  // Row numbers exist only for a sample that was read from a table, not for the mean of several samples.
  for (const int i : fit.used)
    if (!sample.loading.rows.empty()) rows.push_back(sample.loading.rows[i]);
  spdlog::info(
      "{}: the consolidation law was fitted to {} pressures from P* = {:.6g} to {:.6g}{}{}; r.m.s. residual of "
      "1/Phi {:.3g}; standard "
      "errors from {}",
      sample.name, fit.used.size(), fit.window_low, fit.window_high,
      rows.empty() ? "" : ", rows " + ranges(rows),
      fit.n_plateau > 0 ? fmt::format("; the {} pressures below them form the {}", fit.n_plateau,
                                      is_recompressed(fit) ? "recompression line" : "plateau of regime I")
                        : "",
      fit.rms, fit.errors_from_samples ? "the scatter between samples" : "the residuals");
  if (fit.regimes) {
    const std::string pieces =
        change_text(fit.regimes->plateau_end, sample.loading.curve,
                    is_recompressed(fit) ? "the recompression line ends" : "the plateau of regime I ends") +
        change_text(fit.regimes->onset_three, sample.loading.curve, "regime III begins");
    // Each text that change_text() returns begins with "; ", which is removed from the first text.
    if (!pieces.empty()) spdlog::info("{}: {}", sample.name, pieces.substr(2));
  }
  if (fit.regimes && fit.law == ConsolidationLaw::log && fit.regimes->jump_distance > 0.0)
    spdlog::info(
        "{}: the samples collapse in jumps, with a mean distance of {:.2g} in ln P*; {} pressures at the "
        "beginning of regime II are not fitted, because some samples have not collapsed yet and lie above the "
        "line of this regime",
        sample.name, fit.regimes->jump_distance, fit.regimes->n_lagging);
  std::vector<std::string> budget;
  for (const ErrorParts& parts : fit.error_parts)
    budget.push_back(fmt::format(
        "{}: {:.2g} from the scatter and {:.2g} from the ends of the regimes (mainly due to the {})",
        parts.name, parts.scatter, parts.regimes, limit_of(parts, fit)));
  if (!budget.empty())
    spdlog::info(
        "{}: standard errors of the parameters, with one part from {} and one from the uncertain pressures at "
        "which the regimes end: {}",
        sample.name, fit.errors_from_samples ? "the scatter between samples" : "the residuals",
        fmt::join(budget, ", "));
  if (!fit.window_shifts.empty()) {
    std::vector<std::string> pieces;
    for (const WindowShift& s : fit.window_shifts)
      pieces.push_back(
          fmt::format("{} ({})", s.lambda ? fmt::format("{:.4g}", *s.lambda) : "no fit", s.change));
    spdlog::info("{}: values of lambda if one end of the fitted window is moved by one row: {}", sample.name,
                 fmt::join(pieces, ", "));
  }
  if (n_asked > 0)
    spdlog::info("{}: bootstrap: regime II was found in {} of the {} fits to resampled data", sample.name,
                 fit.n_bootstrapped, n_asked);
  for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", sample.name, warning);
}

/// Warns if the mean of the samples leaves out some pressures, because they do not occur in all samples.
/// @param read    samples that were read
/// @param fitted  result of with_pooled() for these samples; its last element is their mean
void warn_of_missing_pressures(const std::vector<ConsolidationSample>& read,
                               const std::vector<ConsolidationSample>& fitted) {
  if (read.size() < 2) return;
  const std::size_t n_common = fitted.back().loading.curve.phi.size();
  const std::size_t n_of_first = read.front().loading.curve.phi.size();
  if (n_common < n_of_first)
    spdlog::warn(
        "pooled: only {} of the {} pressures of {} occur in all {} samples; the other pressures are left out "
        "of the mean of the "
        "samples",
        n_common, n_of_first, read.front().name, read.size());
}

int fit_tables(ConsolidationArguments arguments) {
  arguments.fit.phi_limit = phi_limit_of(arguments.phi_limit);
  const ConsolidationOptions options = consolidation_options(arguments.fit);
  Printing printing = arguments.printing;
  const ColumnNames columns =
      parse_column_names(arguments.columns, names_with_densities({"P_star", "branch"}), printing);
  std::vector<ConsolidationSample> read;
  std::optional<PathTable> first;
  // All samples are read before the first fit, because the mean of the samples is also fitted. The mean needs all
  // pressures in one unit: `first` keeps the unit of the first sample.
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
      spdlog::info(
          "{}: --weights scatter needs the scatter between several samples: this single sample is fitted with "
          "--weights relative instead",
          sample.name);
    fit = fit_of(sample, arguments.fit, options);
    log_fit(sample, fit, arguments.fit.n_bootstrap);
    if (!fit.found()) code = worse(code, kNotConverged);
    array.push_back(as_json(sample, fit, arguments.fit));
    add_rows(sample, fit, arguments.fit, table);
  }
  // If there are several samples, `fit` is the fit of their mean; otherwise, it is the fit of the only sample.
  if (!arguments.plot.empty() && !samples.empty() && fit.found())
    write_plot(arguments.plot, plot_of_fit({samples.back().name, samples.back().unit, samples.back().stress,
                                            samples.back().loading.curve, fit, samples.back().loops()}));
  constexpr std::size_t kOfParameters = 8;
  print_fit(array, table, kOfParameters, printing);
  return code;
}

}  // namespace

Command add_fit_consolidation(CommandLine fit) {
  auto arguments = std::make_shared<ConsolidationArguments>();
  CommandLine app = fit.add_subcommand(
      "consolidation",
      "fit the consolidation law: slope lambda of the virgin compression line, and the other parameters");
  app.add_option("TABLE", arguments->inputs,
                 "tables with the columns P_star (reduced pressure), phi (solid fraction) or void_ratio, and "
                 "optionally branch; or directories of `floc run`; - for a table on stdin")
      .required();
  app.add_option(
         "--law", arguments->fit.law,
         "law to fit: auto (the law that the data support), log (the line of regime II), power (the power "
         "law of regime III) or full (both regimes) [auto; with --protocol or --P0 full]")
      .one_of({"auto", "log", "power", "full"});
  app.add_option("--window", arguments->fit.window,
                 "LOW,HIGH: fit only the rows with reduced pressures P* from LOW to HIGH [a window that is "
                 "found from the data]")
      .delimiter(',')
      .expected(2);
  app.add_option("--protocol", arguments->fit.protocol,
                 "published: fit as in the published work: only the mean of the samples is fitted, with P0* "
                 "fixed at the first fitted pressure "
                 "[P0* is the pressure at which the plateau of regime I meets the line of regime II]")
      .one_of({"published"});
  // The option --P0 excludes --window, because each of the two options selects the pressures that are fitted.
  app.add_option("--P0", arguments->fit.P0,
                 "reduced pressure P0*: fit the pressures from the one nearest to P0* to the last one [found "
                 "from the data]")
      .positive()
      .excludes("--window");
  app.add_option("--loading", arguments->fit.loading,
                 "rows to fit. first: only the first loading; virgin: also later loadings at pressures above "
                 "the largest pressure reached before [virgin with --law auto, otherwise first]")
      .one_of({"first", "virgin"});
  app.add_option("--weights", arguments->fit.weights,
                 "assumed errors of the inverse solid fraction 1/Phi, which determine the weights: uniform "
                 "(equal), relative (proportional to 1/Phi) or scatter (from the scatter between samples) "
                 "[scatter for a mean of three or more samples, otherwise relative; with --law auto, a single "
                 "curve and the line of regime II have weights between uniform and relative]")
      .one_of({"uniform", "relative", "scatter"});
  app.add_option("--loss", arguments->fit.loss,
                 "loss function, which sets the weight of outliers: squared, huber or cauchy [squared]")
      .one_of({"squared", "huber", "cauchy"});
  app.add_option(
      "--phi-limit", arguments->phi_limit,
      "largest solid fraction to which a law may tend at high pressure, or none for no bound, as for "
      "densities measured in a die under load [1]");
  app.add_option("--bootstrap", arguments->fit.n_bootstrap,
                 "N: also estimate errors by the bootstrap, from N resampled fits [no bootstrap]")
      .within(ConsolidationOptions::kBootstrap);
  app.add_option("--seed", arguments->fit.seed, "seed of the random numbers of the bootstrap [1]");
  app.add_option("--stress", arguments->fit.stress,
                 "stress from which the reduced pressure P* of an oedometer test is computed: driven (stress "
                 "along the driven axis) or mean (mean stress) [driven]")
      .one_of({"driven", "mean"});
  add_columns_option(app, arguments->columns, "P_star, phi, void_ratio or another density, branch");
  app.add_option("--plot", arguments->plot,
                 "plot to write (F.svg, F.pdf or F.png): data points, fitted curve, window of the fit and "
                 "residuals; the data F.dat and the gnuplot script F.gp are written to the same directory");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
