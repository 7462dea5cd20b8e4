#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "commands/fit/fit_input.h"
#include "floc/base/error.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/require_elastic.h"
#include "floc/picture/drawn_scale.h"
#include "floc/tables/consolidation_fits.h"
#include "plots/path_plots.h"
#include "plots/pressure_text.h"
#include "plots/state_plots.h"
#include "plots/test_plots.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"
#include "process/run_states.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

struct PlotArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::string show;
  std::vector<int> steps;
  std::string kind = "normal";
  std::string unit = "mean";
  std::string columns;
  std::string phi_limit = "1";
  ColumnNames names;  ///< headers of the columns to read, parsed from `columns`
  Printing printing;
};

/// A plot and the exit code of `floc plot`. The plot is absent if no input could be read.
struct Made {
  int code = kDone;
  std::optional<Plot> plot;
};

Made consolidation(const PlotArguments& arguments, double phi_limit) {
  std::vector<PathTable> samples;
  Made made;
  made.code = for_each_table(arguments.inputs, [&](const std::string& file) {
    PathTable path = read_path(file, arguments.names, {"P_star"}, OedometerPressure::driven, phi_limit);
    log_notes(path);
    if (!samples.empty()) convert_pressures(samples.front(), path);
    samples.push_back(std::move(path));
    return int{kDone};
  });
  if (samples.empty()) return made;
  const FittedConsolidation fitted = fitted_consolidation(samples, phi_limit);
  if (!fitted.fit.found()) {
    spdlog::warn("the consolidation law is not drawn, because it cannot be fitted: {}",
                 fitted.fit.failure_reason);
    made.code = worse(made.code, kNotConverged);
  }
  for (const std::string& warning : fitted.fit.warnings) spdlog::warn("warning: {}", warning);
  made.plot = consolidation_plot(samples, fitted);
  return made;
}

ModuliPoint moduli_of_state(const std::string& file, const AnyState& any) {
  return std::visit(
      [&](const auto& state) {
        require_elastic(state.packing, "moduli are plotted", file);
        ModuliOptions options;
        options.unloaded = state.target_stress.isZero(0.0);
        ModuliPoint point = moduli_point(reduced_pressure(state.packing, state.target_stress.mean()),
                                         elastic_moduli(state.packing, options));
        point.is_driven = !state.path.turn.empty();
        return point;
      },
      any);
}

/// Returns the unit of the moduli in a table of `floc moduli`. The unit depends on whether the packing has cohesion.
/// The table has no column for cohesion. In reduced units with cohesion, however, the reduced pressure P* and the
/// pressure P are almost equal.
std::string unit_of_table(const CsvTable& table) {
  for (const char* name : {"units", "dimension", "P", "P_star"})
    if (!table.has(name)) return "units of the state";
  const int row = table.n_rows() - 1;
  const auto number = [&](const char* name) { return table.number(row, table.column(name)); };
  return stress_unit(table.text(row, table.column("units")), static_cast<int>(number("dimension")),
                     std::abs(number("P") - number("P_star")) < 0.1 * std::abs(number("P")));
}

/// Returns whether the bounds of the moduli in a row of a table of `floc moduli` are valid, according to the column
/// bounds_hold. Tables of floc 0.2 and earlier do not have this column; their bounds are taken as valid if no force
/// acts across a gap.
bool bounds_hold(const CsvTable& table, int row) {
  if (table.has("bounds_hold")) return table.text(row, table.column("bounds_hold")) == "true";
  return !table.has("n_distant") || table.number(row, table.column("n_distant")) == 0.0;
}

/// Returns whether the state in a row of a table of `floc moduli` is stable. A state is stable if the column n_negative
/// (number of negative eigenvalues of the stiffness matrix) is zero. Some methods do not count these eigenvalues and
/// leave the cell empty; an empty cell counts as zero.
bool is_stable(const CsvTable& table, int row) {
  if (!table.has("n_negative")) return true;
  const int column = table.column("n_negative");
  return table.is_empty(row, column) || table.number(row, column) == 0.0;
}

Made moduli(const PlotArguments& arguments) {
  Made made;
  std::vector<ModuliPoint> points;
  std::string unit;
  const std::string& input = arguments.inputs.front();
  if (arguments.inputs.size() == 1 && !fs::is_directory(input) && !input.ends_with(".h5")) {
    const CsvTable table = CsvTable::read(input);
    std::vector<int> columns;
    for (const char* name : {"P_star", "B", "B_S", "G", "B_reuss", "B_voigt", "G_voigt"})
      columns.push_back(table.column(name));
    for (int i = 0; i < table.n_rows(); ++i) {
      const auto x = [&](int k) {
        return table.is_empty(i, columns[k]) ? std::nan("") : table.number(i, columns[k]);
      };
      // A row without Reuss bound belongs to an unloaded packing. The reduced pressure of this row is set to zero, so
      // that the plot, which has a logarithmic axis of pressures, leaves the row out.
      const ModuliPoint point{x(4) > 0.0 ? x(0) : 0.0, x(1), x(2), x(3), x(4), x(5), x(6)};
      points.push_back(point.with_bounds(bounds_hold(table, i), is_stable(table, i)));
    }
    if (table.n_rows() > 0) unit = unit_of_table(table);
  } else {
    made.code = for_each_state(states_of_inputs(arguments.inputs), [&](const std::string& file,
                                                                       const AnyState& state, const Remarks&) {
      points.push_back(moduli_of_state(file, state));
      unit = std::visit(
          []<int Dim>(const State<Dim>& s) { return stress_unit(s.units, Dim, s.packing.law.adheres()); },
          state);
      return int{kDone};
    });
  }
  if (!points.empty()) made.plot = moduli_plot(points, unit);
  return made;
}

Made coordination_of_path(const PlotArguments& arguments) {
  if (arguments.inputs.size() != 1)
    throw InputError("--show coordination", fmt::format("this plot shows a single run: expected one directory "
                                                        "of floc run or one table path.csv, got {} inputs",
                                                        arguments.inputs.size()));
  const std::string& input = arguments.inputs.front();
  const bool is_directory = input != "-" && fs::is_directory(input);
  return {kDone, coordination_plot(CsvTable::read(is_directory ? table_of_run(input) : input))};
}

Made test_of_path(const PlotArguments& arguments) {
  if (arguments.inputs.size() != 1)
    throw InputError("--show test", fmt::format("this plot shows a single run: expected one directory of floc "
                                                "run or one table path.csv, got {} inputs",
                                                arguments.inputs.size()));
  const std::string& input = arguments.inputs.front();
  const bool is_directory = input != "-" && fs::is_directory(input);
  return {kDone, axial_test_plot(CsvTable::read(is_directory ? table_of_run(input) : input))};
}

/// Returns the files of the states to plot. They are the states with the numbers of --steps or, without --steps, three
/// states of each directory, evenly spread from the first to the last.
std::vector<std::string> states_of(const PlotArguments& arguments) {
  return drawn_states(arguments.inputs, arguments.steps, 3);
}

/// Returns the files of the three states of a run whose force distributions are compared: the first state under
/// pressure, the state at the highest pressure, and the state half way between them along the path. States without
/// pressure are left out, because their forces are only rounding errors or errors of the solver.
std::vector<std::string> loading_states(const std::string& directory) {
  const std::vector<PathRow> rows = read_path(table_of_run(directory), {}).rows;
  const auto highest = static_cast<int>(std::ranges::max_element(rows, {}, &PathRow::P_star) - rows.begin());
  int first = 0;
  while (first < highest && rows[static_cast<std::size_t>(first)].P_star <= 0.0) ++first;
  std::vector<int> steps;
  for (const int step : {first, (first + highest) / 2, highest})
    if (steps.empty() || step != steps.back()) steps.push_back(step);
  return states_of_inputs({directory}, steps);
}

/// Returns the files of the states whose force distributions are plotted.
std::vector<std::string> force_states(const PlotArguments& arguments) {
  if (!arguments.steps.empty()) return states_of(arguments);
  std::vector<std::string> files;
  for (const std::string& input : arguments.inputs) {
    const bool is_run = input != "-" && fs::is_directory(input);
    for (const std::string& file : is_run ? loading_states(input) : std::vector<std::string>{input})
      files.push_back(file);
  }
  return files;
}

/// Returns the name of a state in the legend of a plot: its reduced pressure and the name of its branch of the load
/// path. The name of the branch is omitted for the first loading.
std::string name_of_state(const AnyState& any) {
  return std::visit(
      [](const auto& state) {
        const std::string& branch = state.path.branch;
        const bool loading = branch.empty() || branch == "load" || branch == "assembly" || branch == "imported";
        return pressure_text(state) + (loading ? "" : ", " + branch);
      },
      any);
}

Made forces(const PlotArguments& arguments) {
  const ForceKind kind = arguments.kind == "tangential" ? ForceKind::tangential
                         : arguments.kind == "rolling"  ? ForceKind::rolling
                                                        : ForceKind::normal;
  const ForceUnit unit = arguments.unit == "mean" ? ForceUnit::mean : ForceUnit::pull_off;
  Made made;
  std::vector<ForceSample> samples;
  made.code = for_each_state(force_states(arguments), [&](const std::string& file, const AnyState& any,
                                                          const Remarks&) {
    samples.push_back(std::visit(
        [&](const auto& state) { return force_sample(file, name_of_state(any), state.packing, kind, unit); },
        any));
    return int{kDone};
  });
  if (!samples.empty()) made.plot = forces_plot(samples, kind, unit);
  return made;
}

Made pressures(const PlotArguments& arguments) {
  Made made;
  std::vector<PressureSample> samples;
  made.code = for_each_state(states_of(arguments), [&](const std::string& file, const AnyState& any,
                                                       const Remarks&) {
    PressureSample sample = std::visit(
        [&](const auto& state) {
          const double zero = state.tolerance.force * force_scale(state.packing, state.target_stress).force;
          return pressure_sample(file, name_of_state(any), state.packing, zero);
        },
        any);
    if (!samples.empty() && samples.front().over_adhesion != sample.over_adhesion)
      throw InputError(
          file,
          "the particle pressures of this state and of the states before it have different units, because only "
          "some of the states have adhesion: plot the states with adhesion and those without it separately");
    samples.push_back(std::move(sample));
    return int{kDone};
  });
  if (!samples.empty()) made.plot = pressures_plot(samples);
  return made;
}

Made scattering_of_states(const PlotArguments& arguments) {
  Made made;
  std::vector<ScatteringSample> samples;
  made.code =
      for_each_state(states_of(arguments), [&](const std::string& file, const AnyState& any, const Remarks&) {
        ScatteringSample sample = std::visit(
            [&](const auto& state) {
              require_round(state.packing, "the scattered intensity is plotted", file);
              return scattering_sample(name_of_state(any), state.packing);
            },
            any);
        if (!samples.empty() && samples.front().dimension != sample.dimension)
          throw InputError(file, fmt::format("this is a state in {}D, but the states before it are not: all "
                                             "states in a plot of I(k) must have the same dimension",
                                             sample.dimension));
        samples.push_back(std::move(sample));
        if (!samples.back().failure_reason.empty())
          spdlog::warn("{}: the law of fractal aggregates is not drawn, because it cannot be fitted: {}", file,
                       samples.back().failure_reason);
        return int{kDone};
      });
  if (!samples.empty()) made.plot = scattering_plot(samples);
  return made;
}

constexpr int kDirections = 36;  // number of bins of a rose diagram; they cover 180 degrees, five degrees each

Made fabric(const PlotArguments& arguments) {
  Made made;
  std::vector<std::pair<std::string, ContactDirections>> states;
  made.code =
      for_each_state(states_of(arguments), [&](const std::string& file, const AnyState& any, const Remarks&) {
        const State<2>* state = std::get_if<State<2>>(&any);
        if (state == nullptr)
          throw InputError(file,
                           "this is a state of spheres, but rose diagrams show only states of disks; floc "
                           "network prints the fabric tensor of spheres");
        states.emplace_back(name_of_state(any), contact_directions(state->packing, kDirections));
        return int{kDone};
      });
  if (!states.empty()) made.plot = fabric_plot(states);
  return made;
}

Made make(const PlotArguments& arguments) {
  const double phi_limit =
      phi_limit_of(arguments.phi_limit);  // an invalid value is rejected for every kind of plot
  if (arguments.show == "test") return test_of_path(arguments);
  if (arguments.show == "fabric") return fabric(arguments);
  if (arguments.show == "forces") return forces(arguments);
  if (arguments.show == "pressures") return pressures(arguments);
  if (arguments.show == "scattering") return scattering_of_states(arguments);
  if (arguments.show == "moduli") return moduli(arguments);
  if (arguments.show == "coordination") return coordination_of_path(arguments);
  return consolidation(arguments, phi_limit);
}

int plot(const PlotArguments& arguments) {
  const Made made = make(arguments);
  if (!made.plot) return made.code;
  write_plot(arguments.output, *made.plot);
  const auto beside = [&](const char* ending) {
    return fs::path(arguments.output).replace_extension(ending).string();
  };
  std::int64_t n_points = 0;
  for (const Plot::Block& block : made.plot->blocks) n_points += static_cast<std::int64_t>(block.rows.size());
  print_table({{"shows", "picture", "data", "script", "n_rows"},
               {{arguments.show, arguments.output, beside(".dat"), beside(".gp"), n_points}}},
              arguments.printing);
  return made.code;
}

}  // namespace

Command add_plot(CommandLine program) {
  CommandLine app = program.add_subcommand("plot",
                                           "Plot load paths and states with gnuplot; write the plotted data "
                                           "and the gnuplot script to the directory of the plot");
  const auto arguments = std::make_shared<PlotArguments>();
  app.add_option("INPUT", arguments->inputs,
                 "directories of floc run, tables, or state files; - for a table on stdin")
      .required();
  app.add_option("-o,--output", arguments->output,
                 "plot to write: F.svg, F.pdf or F.png; the data F.dat and the gnuplot script F.gp are written "
                 "to the same directory")
      .required();
  app.add_option(
         "--show", arguments->show,
         "quantity to plot. consolidation: inverse solid fraction 1/Phi against reduced pressure P* of runs, "
         "with "
         "the fitted consolidation law and its regimes, unloading branches and elastic lines; moduli: elastic "
         "moduli and "
         "their bounds, of states or of a table of floc moduli; coordination: coordination numbers of a run, "
         "for all contacts and for each sign of the normal force; forces: distributions of contact forces of "
         "states; pressures: "
         "distributions of particle pressures of states; scattering: scattered intensity I(k) of states and "
         "the fitted law; test: stress ratio q/p and volumetric strain against axial strain, and the lateral "
         "stress ratio K0, of a run with a driven axis; fabric: rose diagrams of the contact directions of "
         "states [forces for state files, otherwise consolidation]")
      .one_of(
          {"consolidation", "moduli", "coordination", "forces", "pressures", "scattering", "test", "fabric"});
  app.add_option("--steps", arguments->steps,
                 "K,...: numbers of the states of a directory to plot with --show forces, pressures, "
                 "scattering or fabric [for forces, the states at the lowest and highest pressure of loading "
                 "and half way between; otherwise three states, evenly spread from the first to the last]")
      .delimiter(',')
      .non_negative();
  app.add_option("--kind", arguments->kind,
                 "forces to plot with --show forces: normal, tangential or rolling (moments) [normal]")
      .one_of({"normal", "tangential", "rolling"});
  app.add_option("--unit", arguments->unit,
                 "unit of the plotted forces: mean (mean of their magnitudes) or F0 (pull-off force) [mean]")
      .one_of({"mean", "F0"});
  add_phi_limit_option(app, arguments->phi_limit);
  add_columns_option(app, arguments->columns, "P_star, phi, void_ratio, branch");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] {
            // The default of --show depends on the inputs, so it is set here, after the command line has been parsed.
            if (arguments->show.empty())
              arguments->show = arguments->inputs.front().ends_with(".h5") ? "forces" : "consolidation";
            arguments->names = parse_column_names(
                arguments->columns, names_with_densities({"P_star", "branch"}), arguments->printing);
            return plot(*arguments);
          }};
}

}  // namespace floc
