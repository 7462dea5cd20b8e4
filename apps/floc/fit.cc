#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "floc/base/error.h"
#include "floc/fitting/consolidation.h"
#include "floc/io/csv.h"
#include "output.h"

namespace floc {
namespace {

using Json = nlohmann::ordered_json;

struct FitArguments {
  std::vector<std::string> inputs;
  std::string law = "full";
  std::string protocol;
  std::vector<double> window;
  std::string format;
};

/// A named curve with the rows of its table.
struct Sample {
  std::string name;
  FirstLoading loading;
};

/// Tables of an argument: itself, DIR/path.csv, or DIR/seed-N/path.csv in the order of N.
std::vector<std::string> tables_of(const std::string& input) {
  namespace fs = std::filesystem;
  if (input == "-" || !fs::is_directory(input)) return {input};
  const fs::path own = fs::path(input) / "path.csv";
  if (fs::exists(own)) return {own.string()};
  std::map<std::pair<std::size_t, std::string>, std::string> by_seed;
  for (const auto& entry : fs::directory_iterator(input)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("seed-") && fs::exists(entry.path() / "path.csv"))
      by_seed[{name.size(), name}] = (entry.path() / "path.csv").string();
  }
  if (by_seed.empty()) throw InputError(input, "holds neither path.csv nor seed-N/path.csv");
  std::vector<std::string> tables;
  for (const auto& [seed, table] : by_seed) tables.push_back(table);
  return tables;
}

std::vector<PathRow> read_rows(const CsvTable& table) {
  const int pressure = table.column("P_star");
  const int fraction = table.column("phi");
  const int branch = table.has("branch") ? table.column("branch") : -1;
  std::vector<PathRow> rows;
  for (int i = 0; i < table.n_rows(); ++i) {
    rows.push_back(
        {branch >= 0 ? table.text(i, branch) : "", table.number(i, pressure), table.number(i, fraction)});
    if (rows.back().P_star < 0)
      throw InputError(table.place(i),
                       fmt::format("P_star = {}: expected a pressure >= 0", rows.back().P_star));
    if (rows.back().phi <= 0)
      throw InputError(table.place(i),
                       fmt::format("phi = {}: expected a positive solid fraction", rows.back().phi));
  }
  return rows;
}

Sample read_sample(const std::string& path) {
  const CsvTable table = CsvTable::read(path);
  Sample sample{path == "-" ? "stdin" : path, first_loading(read_rows(table))};
  const std::vector<double>& P = sample.loading.curve.P_star;
  const auto fall = std::is_sorted_until(P.begin(), P.end());
  if (fall != P.end())
    throw InputError(table.place(sample.loading.rows[static_cast<std::size_t>(fall - P.begin())]),
                     fmt::format("P_star = {}: expected pressures that grow along the first loading", *fall));
  if (sample.loading.n_zero_pressure > 0)
    spdlog::info("{}: {} row(s) at P* = 0 left out", sample.name, sample.loading.n_zero_pressure);
  return sample;
}

/// Reads all samples; what cannot be read is reported by name and the rest is still done.
std::vector<Sample> read_samples(const std::vector<std::string>& inputs, int& code) {
  std::vector<Sample> samples;
  for (const std::string& input : inputs) {
    try {
      for (const std::string& table : tables_of(input)) samples.push_back(read_sample(table));
    } catch (const InputError& error) {
      std::cerr << "floc: " << error.what() << '\n';
      code = worse(code, kBadInput);
    }
  }
  return samples;
}

ConsolidationOptions options_of(const FitArguments& arguments) {
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
  return options;
}

Json number_or_null(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? Json(*x) : Json(nullptr);
}

Json as_json(const std::string& name, const Sample& sample, const ConsolidationFit& fit,
             const FitArguments& arguments) {
  Json object;
  object["sample"] = name;
  object["law"] = arguments.law;
  object["protocol"] = arguments.protocol.empty() ? "automatic" : arguments.protocol;
  object["refusal"] = fit.found() ? Json(nullptr) : Json(fit.refusal);
  object["window"] = fit.found() ? Json{fit.window_low, fit.window_high} : Json(nullptr);
  object["n_points"] = fit.used.size();
  object["n_plateau"] = fit.n_plateau;
  object["parameters"] = Json::object();
  for (const FittedParameter& p : fit.parameters)
    object["parameters"][p.name] = {{"value", number_or_null(p.value)},
                                    {"stderr", number_or_null(p.standard_error)},
                                    {"low95", number_or_null(p.low95)},
                                    {"high95", number_or_null(p.high95)},
                                    {"identified", p.identified}};
  object["correlation"] = Json::object();
  for (std::size_t i = 0; i < fit.correlated.size(); ++i)
    for (std::size_t j = 0; j < fit.correlated.size(); ++j)
      object["correlation"][fit.correlated[i]][fit.correlated[j]] = number_or_null(fit.correlation(i, j));
  object["rms"] = fit.found() ? Json(fit.rms) : Json(nullptr);
  object["rows_used"] = Json::array();
  object["P_star_used"] = Json::array();
  for (const int i : fit.used) {
    if (!sample.loading.rows.empty()) object["rows_used"].push_back(sample.loading.rows[i]);
    object["P_star_used"].push_back(sample.loading.curve.P_star[i]);
  }
  object["warnings"] = fit.warnings;
  return object;
}

void add_table_rows(const std::string& name, const ConsolidationFit& fit, const FitArguments& arguments,
                    Table& table) {
  const auto cell = [](const std::optional<double>& x) { return x ? TableValue(*x) : TableValue(); };
  for (const FittedParameter& p : fit.parameters)
    table.rows.push_back({name, arguments.law, p.name, cell(p.value), cell(p.standard_error), cell(p.low95),
                          cell(p.high95), p.identified, fit.window_low, fit.window_high,
                          static_cast<std::int64_t>(fit.used.size()), fit.rms});
}

/// For the terminal: what the words on stderr do not say already.
Table without_context(Table table) {
  constexpr std::size_t kOfParameters = 8;
  table.columns.resize(kOfParameters);
  for (auto& row : table.rows) row.resize(kOfParameters);
  return table;
}

/// Row numbers as ranges, "1-9, 12".
std::string ranges(const std::vector<int>& rows) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t j = i;
    while (j + 1 < rows.size() && rows[j + 1] == rows[j] + 1) ++j;
    parts.push_back(i == j ? fmt::format("{}", rows[i]) : fmt::format("{}-{}", rows[i], rows[j]));
    i = j + 1;
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void say(const std::string& name, const Sample& sample, const ConsolidationFit& fit) {
  if (!fit.found()) {
    spdlog::warn("{}: no fit: {}", name, fit.refusal);
    return;
  }
  std::vector<int> rows;
  for (const int i : fit.used)
    if (!sample.loading.rows.empty()) rows.push_back(sample.loading.rows[i]);
  spdlog::info(
      "{}: fitted {} pressures, P* = {:.6g} to {:.6g}{}{}; r.m.s. residual of 1/Phi {:.3g}", name,
      fit.used.size(), fit.window_low, fit.window_high, rows.empty() ? "" : ", rows " + ranges(rows),
      fit.n_plateau > 0 ? fmt::format("; the {} before them are the plateau of regime I", fit.n_plateau) : "",
      fit.rms);
  for (const std::string& warning : fit.warnings) spdlog::warn("{}: warning: {}", name, warning);
}

/// What is fitted: each sample and their mean; the published protocol fits the mean alone.
std::vector<Sample> with_pooled(std::vector<Sample> samples, bool only_pooled) {
  if (samples.size() < 2) return samples;
  std::vector<ConsolidationCurve> curves;
  for (const Sample& s : samples) curves.push_back(s.loading.curve);
  Sample pooled{"pooled", {pooled_curve(curves), {}, 0}};
  if (pooled.loading.curve.phi.size() < curves.front().phi.size())
    spdlog::warn("pooled: {} of the {} pressures of {} are common to all {} samples",
                 pooled.loading.curve.phi.size(), curves.front().phi.size(), samples.front().name,
                 samples.size());
  if (only_pooled) return {pooled};
  samples.push_back(std::move(pooled));
  return samples;
}

int fit_tables(const FitArguments& arguments) {
  const ConsolidationOptions options = options_of(arguments);
  int code = kDone;
  const std::vector<Sample> samples = with_pooled(read_samples(arguments.inputs, code), options.hold_P0);
  Json array = Json::array();
  Table table{{"sample", "law", "parameter", "value", "stderr", "low95", "high95", "identified", "P_star_low",
               "P_star_high", "n_points", "rms"},
              {}};
  for (const Sample& sample : samples) {
    const ConsolidationFit fit = fit_consolidation(sample.loading.curve, options);
    say(sample.name, sample, fit);
    if (!fit.found()) code = worse(code, kNotConverged);
    array.push_back(as_json(sample.name, sample, fit, arguments));
    add_table_rows(sample.name, fit, arguments, table);
  }
  if (arguments.format == "json")
    std::cout << array.dump(2) << '\n' << std::flush;
  else
    print_table(chosen_format(arguments.format) == TableFormat::table ? without_context(table) : table,
                arguments.format);
  if (!std::cout) throw IoError("standard output", "cannot be written");
  return code;
}

}  // namespace

Command add_fit(CLI::App& program) {
  auto arguments = std::make_shared<FitArguments>();
  CLI::App* app = program.add_subcommand("fit", "fit a law to a table");
  app->require_subcommand(1);
  CLI::App* consolidation =
      app->add_subcommand("consolidation", "plasticity index lambda and the other parameters of consolidation");
  consolidation
      ->add_option("TABLE", arguments->inputs,
                   "tables with columns P_star, phi and perhaps branch; directories of `floc run`; - is stdin")
      ->required();
  consolidation
      ->add_option("--law", arguments->law, "log (regime II), power (regime III) or full (both) [full]")
      ->check(CLI::IsMember({"log", "power", "full"}));
  consolidation->add_option("--window", arguments->window, "lo,hi: fit on these P* only [found]")
      ->delimiter(',')
      ->expected(2);
  consolidation
      ->add_option("--protocol", arguments->protocol,
                   "published: P0* on the grid and held, the mean of the samples fitted [where the plateau "
                   "meets the line]")
      ->check(CLI::IsMember({"published"}));
  add_format_option(*consolidation, arguments->format);
  return {app, [arguments] { return fit_tables(*arguments); }};
}

}  // namespace floc
