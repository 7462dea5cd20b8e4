#include "floc/tradeoff/tradeoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "floc/base/error.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "plots/tradeoff_plot.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct TradeoffCommand {
  std::string scene;
  std::vector<std::string> overrides;
  std::vector<std::string> observables;
  std::string plot;
  Printing printing;
  TradeoffOptions options;
};

std::vector<std::string> observable_names() {
  std::vector<std::string> names(kObservableNames.begin(), kObservableNames.end());
  names.insert(names.end(), kFittedNames.begin(), kFittedNames.end());
  return names;
}

/// Returns the table cell of an error that was found by comparing n values. The cell is undefined if n is 0 or the
/// error is not finite.
TableValue of_compared(int n, double value) {
  return n > 0 && std::isfinite(value) ? TableValue{value} : TableValue{};
}

/// Name and dimensionless contact stiffness of the scene that was run. Each row of the table contains both.
struct StudiedScene {
  std::string name;
  /// Dimensionless contact stiffness: a K_N/F0 or, without adhesion, K_N/P (a: diameter, K_N: normal stiffness, F0:
  /// pull-off force, P: pressure).
  double kappa;
};

std::vector<TableValue> row_of(const StudiedScene& run, const MeasuredSetting& m, const std::string& observable,
                               const ObservableError& e, bool pareto) {
  const NumericalSettings& s = m.setting.numerical;
  return {m.setting.parameter,
          m.setting.value,
          observable,
          m.cost_ratio,
          m.core_seconds,
          of_compared(e.before.n, e.before.high),
          of_compared(e.after.n, e.after.high),
          of_compared(e.mean.n, e.mean.difference),
          of_compared(e.mean.n, e.mean.standard_error),
          of_compared(e.mean.n, e.mean.error95),
          pareto,
          of_compared(e.before.n, e.before.error),
          std::int64_t{e.before.n},
          of_compared(e.after.n, e.after.error),
          std::int64_t{e.after.n},
          std::int64_t{e.mean.n},
          m.moduli_seconds,
          std::int64_t{m.n_grains},
          std::int64_t{m.n_samples},
          s.tolerance,
          s.time_step,
          std::string(finish_name(s.finish)),
          s.patience,
          run.kappa,
          run.name};
}

Table table_of(const StudiedScene& run, const Tradeoff& tradeoff, const std::vector<std::string>& wanted) {
  Table table;
  table.columns = {"knob",
                   "value",
                   "observable",
                   "cost_ratio",
                   "core_seconds",
                   "error_before_high",
                   "error_after_high",
                   "mean_difference",
                   "mean_stderr",
                   "mean_error95",
                   "pareto",
                   "error_before",
                   "n_before",
                   "error_after",
                   "n_after",
                   "n_mean",
                   "moduli_seconds",
                   "n_grains",
                   "n_samples",
                   "tolerance",
                   "time_step",
                   "finish",
                   "patience",
                   "kappa",
                   "scene"};
  const std::vector<std::string> names = observable_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), names[k]) == wanted.end()) continue;
    // The Pareto front contains the numerical settings for which no other setting is both cheaper and more accurate. It
    // is determined for each observable separately, because a setting may be on the front of one observable and not on
    // that of another.
    const std::vector<bool> front = pareto_front(tradeoff, k);
    for (std::size_t i = 0; i < tradeoff.settings.size(); ++i) {
      const MeasuredSetting& m = tradeoff.settings[i];
      const ObservableError& e = m.errors[k];
      // A setting has no row if it gave no value of this observable that could be compared.
      if (e.before.n + e.after.n + e.mean.n > 0) table.rows.push_back(row_of(run, m, names[k], e, front[i]));
    }
  }
  return table;
}

double stiffness_of(const Scene& scene) {
  for (const DerivedGroup& group : derived_groups(scene))
    if (group.name == "kappa") return group.value;
  return 0.0;
}

/// Prints the table. In the format "table" only its first columns are printed, unless the user has chosen columns.
void print_tradeoff(Table table, const Printing& printing) {
  constexpr std::size_t kShort = 11;
  if (chosen_format(printing.format) == TableFormat::table && printing.columns.empty()) {
    table.columns.resize(kShort);
    for (auto& row : table.rows) row.resize(kShort);
  }
  print_table(table, printing);
}

int run_tradeoff(TradeoffCommand& command) {
  const Scene scene = read_scene(command.scene, command.overrides);
  if (scene.dimension != 2)
    throw InputError(
        command.scene,
        fmt::format(
            "scene.dimension = {}: expected 2, because floc tradeoff measures costs and errors only for disks",
            scene.dimension));
  command.options.progress = [](const std::string& message) { std::cerr << message << '\n'; };
  const Tradeoff tradeoff = study_tradeoff(scene, command.options);
  std::cerr << "floc tradeoff does not vary two settings: power control, which equilibrium.finish = dynamic "
               "switches on, and the precision in which forces are computed, which is always double\n";
  for (const std::string& message : tradeoff.left_out)
    std::cerr << "left out of the study: " << message << '\n';
  if (tradeoff.settings.empty()) {
    std::cerr << "floc: " << command.scene
              << ": no results could be compared, because not even one sample was completed with the strictest "
                 "numerical settings; give a larger --budget\n";
    return kNotConverged;
  }
  print_tradeoff(table_of({scene.name, stiffness_of(scene)}, tradeoff, command.observables), command.printing);
  if (!command.plot.empty()) plot_tradeoff(command.plot, tradeoff);
  return kDone;
}

}  // namespace

Command add_tradeoff(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "tradeoff",
      "Run a scene with several numerical settings, and compare the error of its results with their cost");
  const auto command = std::make_shared<TradeoffCommand>();
  app.add_option("SCENE", command->scene, "scene file (TOML)").required();
  app.add_option("--budget", command->options.budget, "processor time that the study may take, on one core (s)")
      .positive()
      .show_default();
  app.add_option(
         "--samples", command->options.max_samples,
         "largest number of samples; their seeds are successive numbers that begin with the seed of the scene")
      .within(TradeoffOptions::kSamples)
      .show_default();
  app.add_option("--set", command->overrides,
                 "KEY=VALUE: set one key of the scene to another value, e.g. grains.count=200")
      .one_argument_each();
  app.add_option("--observables", command->observables,
                 "results whose errors are compared: phi, B, lambda, ... [all]")
      .delimiter(',')
      .one_argument_each()
      .one_of(observable_names());
  app.add_option("--plot", command->plot,
                 "F.svg: plot to write, of the error against the cost; the data and the gnuplot script are "
                 "written to the same directory");
  add_printing_options(app, command->printing);
  return {app, [command] { return run_tradeoff(*command); }};
}

}  // namespace floc
