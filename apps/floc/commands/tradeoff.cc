#include "floc/tradeoff/tradeoff.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "floc/base/error.h"
#include "floc/lattice/cemented_sample.h"
#include "floc/planning/duration.h"
#include "floc/prices/price_table.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "floc/tables/column.h"
#include "floc/tradeoff/lattice_study.h"
#include "plots/gnuplot.h"
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
  std::string budget = "600";  ///< see duration_of()
  Printing printing;
  TradeoffOptions options;
  /// volume fraction of the matrix in a study of cemented grains; absent in other studies
  std::optional<double> matrix_content;
  double stiffness_ratio = LatticeStudyOptions{}.stiffness_ratio;
};

TableValue or_undefined_number(double value) {
  return std::isfinite(value) ? TableValue{value} : TableValue{};
}

/// Returns a table cell with an error that was computed from n comparisons. The cell is empty if n is 0 or the
/// error is not finite.
TableValue of_compared(int n, double value) {
  return n > 0 ? or_undefined_number(value) : TableValue{};
}

/// The scene of the study, and the values of the columns that are equal in all rows of the table.
struct StudiedScene {
  const Scene& scene;
  Subject subject;
  std::string kind;
  /// Dimensionless contact stiffness: a K_N/F0 or, without adhesion, K_N/P (a: diameter, K_N: normal stiffness, F0:
  /// pull-off force, P: pressure); undefined for rigid contacts.
  TableValue kappa;
};

/// One row of the table: the errors of one observable with one numerical setting.
struct TradeoffRow {
  const StudiedScene& run;
  const Tradeoff& tradeoff;
  const MeasuredSetting& setting;
  std::size_t observable;
  bool pareto;

  const ObservableError& error() const { return setting.errors[observable]; }
  const DeclaredObservable& declared() const { return declared_observables()[observable]; }
};

/// Returns the factor by which the springs are softened in one part of the run; undefined for lattices and for grains
/// without springs.
TableValue softening_cell(const TradeoffRow& row, double Softening::*part) {
  if (row.run.scene.law.is_rigid() || row.setting.setting.lattice) return {};
  return row.setting.setting.numerical.softening.*part;
}

/// Returns the masses with which grains move, as words; undefined for lattices and for rigid grains.
TableValue masses_cell(const TradeoffRow& row) {
  if (row.run.scene.law.is_rigid() || row.setting.setting.lattice) return {};
  return std::string(masses_name(row.setting.setting.numerical.equal_masses));
}

const std::vector<Column<TradeoffRow>>& tradeoff_columns() {
  using Row = TradeoffRow;
  // The order of the columns matters: in the format "table", print_tradeoff() prints only the first eleven columns,
  // from knob to pareto, if the user has chosen no columns. A new column must not be inserted among them.
  static const std::vector<Column<Row>> columns = {
      {"knob", [](const Row& r) { return r.setting.setting.parameter; }},
      {"value", [](const Row& r) { return r.setting.setting.value; }},
      {"observable", [](const Row& r) { return std::string(r.declared().name); }},
      {"cost_ratio", [](const Row& r) { return r.setting.cost_ratio; }},
      {"core_seconds", [](const Row& r) { return r.setting.core_seconds; }},
      {"error_before_high",
       [](const Row& r) { return of_compared(r.error().before.n, r.error().before.high); }},
      {"error_after_high", [](const Row& r) { return of_compared(r.error().after.n, r.error().after.high); }},
      {"mean_difference",
       [](const Row& r) { return of_compared(r.error().mean.n, r.error().mean.difference); }},
      {"mean_stderr",
       [](const Row& r) { return of_compared(r.error().mean.n, r.error().mean.standard_error); }},
      {"mean_error95", [](const Row& r) { return of_compared(r.error().mean.n, r.error().mean.error95); }},
      {"pareto", [](const Row& r) { return r.pareto; }},
      {"error_before", [](const Row& r) { return of_compared(r.error().before.n, r.error().before.error); }},
      {"n_before", [](const Row& r) { return count(r.error().before.n); }},
      {"error_after", [](const Row& r) { return of_compared(r.error().after.n, r.error().after.error); }},
      {"n_after", [](const Row& r) { return count(r.error().after.n); }},
      {"n_mean", [](const Row& r) { return count(r.error().mean.n); }},
      {"moduli_seconds", [](const Row& r) { return r.setting.moduli_seconds; }},
      {"n_grains", [](const Row& r) { return count(r.setting.n_grains); }},
      {"n_samples", [](const Row& r) { return count(r.setting.n_samples); }},
      {"tolerance", [](const Row& r) { return tolerance_of(r.setting.setting); }},
      {"time_step",
       [](const Row& r) { return or_undefined_number(time_step_of(r.run.scene, r.setting.setting)); }},
      {"finish", [](const Row& r) { return finish_of(r.run.scene, r.setting.setting); }},
      {"patience", [](const Row& r) { return or_undefined_number(patience_of(r.setting.setting)); }},
      {"kappa", [](const Row& r) { return r.run.kappa; }},
      {"scene", [](const Row& r) { return r.run.scene.name; }},
      {"kind", [](const Row& r) { return r.run.kind; }},
      {"reference_value", [](const Row& r) { return or_undefined_number(r.tradeoff.reference[r.observable]); }},
      {"unit", [](const Row& r) { return unit_of(r.declared(), r.run.scene); }},
      {"sample_scatter", [](const Row& r) { return or_undefined_number(r.tradeoff.scatter[r.observable]); }},
      {"n_states", [](const Row& r) { return count(r.tradeoff.n_states); }},
      {"memory_mb", [](const Row& r) { return or_undefined_number(r.setting.memory); }},
      {"softening", [](const Row& r) { return softening_cell(r, &Softening::load); }},
      {"assembly_softening", [](const Row& r) { return softening_cell(r, &Softening::assembly); }},
      {"masses", masses_cell},
      {"version", [](const Row&) { return std::int64_t{kPriceTableVersion}; }},
  };
  return columns;
}

Table table_of(const StudiedScene& run, const Tradeoff& tradeoff, const std::vector<std::string>& wanted) {
  std::vector<TradeoffRow> rows;
  const std::vector<std::string> names = observable_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), names[k]) == wanted.end()) continue;
    if (!applies(declared_observables()[k], run.scene, run.subject)) continue;
    // The Pareto front contains a numerical setting if no other setting is both cheaper and more accurate. Each
    // observable has its own Pareto front.
    const std::vector<bool> front = pareto_front(tradeoff, k);
    for (std::size_t i = 0; i < tradeoff.settings.size(); ++i) {
      const MeasuredSetting& m = tradeoff.settings[i];
      const ObservableError& e = m.errors[k];
      // A setting has no row if no value of this observable could be compared.
      if (e.before.n + e.after.n + e.mean.n > 0) rows.push_back({run, tradeoff, m, k, front[i]});
    }
  }
  return to_table(tradeoff_columns(), rows);
}

TableValue stiffness_of(const Scene& scene) {
  for (const DerivedGroup& group : derived_groups(scene))
    if (group.name == "kappa") return group.value;
  return {};
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

Tradeoff study(const TradeoffCommand& command, const Scene& scene) {
  if (!command.matrix_content) return study_tradeoff(scene, command.options);
  return study_lattice(scene, {*command.matrix_content, command.stiffness_ratio}, command.options);
}

int run_tradeoff(TradeoffCommand& command) {
  const Scene scene = read_scene(command.scene, command.overrides);
  const Subject subject = command.matrix_content ? Subject::lattice : Subject::states;
  require_observables(command.observables, scene, subject);
  if (!command.plot.empty()) require_plot_name(command.plot);
  command.options.progress = [](const std::string& message) { std::cerr << message << '\n'; };
  const Tradeoff tradeoff = study(command, scene);
  if (subject == Subject::states && !scene.law.is_rigid())
    std::cerr
        << "floc tradeoff does not vary the precision in which forces are computed, which is always double\n";
  for (const std::string& message : tradeoff.left_out)
    std::cerr << "left out of the study: " << message << '\n';
  if (tradeoff.settings.empty()) {
    std::cerr << "floc: " << command.scene
              << ": no results could be compared, because not even one sample was completed with the strictest "
                 "numerical settings; give a larger --budget\n";
    return kNotConverged;
  }
  const StudiedScene run{scene, subject, kind_of_study(scene, subject), stiffness_of(scene)};
  print_tradeoff(table_of(run, tradeoff, command.observables), command.printing);
  if (!command.plot.empty()) plot_tradeoff(command.plot, tradeoff);
  return kDone;
}

}  // namespace

Command add_tradeoff(CommandLine program) {
  CommandLine app = program.add_subcommand("tradeoff",
                                           "Run a scene with several numerical settings, and compare the "
                                           "errors of the results with the costs of the settings");
  const auto command = std::make_shared<TradeoffCommand>();
  app.add_option("SCENE", command->scene, "scene file (TOML)").required();
  app.add_option("--budget", command->budget,
                 "processor time that the study may take, on one core, such as 90s, 30min, 2h, 3d or 1y")
      .show_default();
  app.add_option("--samples", command->options.max_samples,
                 "largest number of samples; the first sample has the seed of the scene, each further sample "
                 "the next seed")
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
  app.add_option(
         "--knobs", command->options.parameters,
         "parameters whose values are compared with the strictest settings and with the scene as it is: "
         "time_step, softening, ... [all]")
      .delimiter(',')
      .one_argument_each();
  // The variable of this option has no default value: the lattice is studied only if the variable has a value.
  const Option lattice =
      app.add_option(
             "--lattice", command->matrix_content,
             "volume fraction of a matrix that cements the grains of the last state; the lattice of floc "
             "lattice is then studied instead of the states")
          .within(CementOptions::kContent);
  app.add_option("--stiffness-ratio", command->stiffness_ratio,
                 "with --lattice, ratio of the stiffness of the grains to the stiffness of the matrix")
      .within(LatticeStudyOptions::kRatio)
      .needs(lattice)
      .show_default();
  app.add_option("--plot", command->plot,
                 "plot to write (F.svg): errors against costs; the data and the gnuplot script are "
                 "written to the same directory");
  add_printing_options(app, command->printing);
  return {app, [command]() -> int {
            try {
              command->options.budget = duration_of("--budget", command->budget);
            } catch (const InputError& error) {
              spdlog::error("floc: {}", error.what());
              return kUsage;
            }
            return run_tradeoff(*command);
          }};
}

}  // namespace floc
