#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "floc/base/error.h"
#include "floc/base/sha256.h"
#include "floc/elasticity/moduli.h"
#include "floc/io/law_text.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/equilibrium_check.h"
#include "floc/packing/require_periodic.h"
#include "floc/picture/drawn_scale.h"
#include "floc/picture/sheet.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "floc/structure/coordination.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/network_rows.h"
#include "plots/html.h"
#include "plots/path_plots.h"
#include "plots/pressure_text.h"
#include "plots/state_picture.h"
#include "plots/state_plots.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"
#include "process/run_states.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string directory;
  std::string output;
  Printing printing;
};

/// The data that the report of a run shows. They are read once and used in all sections of the report.
template <int Dim>
struct ReportedRun {
  std::string directory;
  PathTable path;
  std::vector<std::string> files;
  std::vector<State<Dim>> shown;  ///< states whose pictures and distributions are shown
  std::vector<std::string> shown_files;
  std::optional<State<Dim>> first;
  std::vector<ModuliPoint> moduli;
  /// Whether the contacts are rigid. States with rigid contacts have no moduli and, without adhesion, no reduced
  /// pressures. The report then describes their contacts instead.
  bool is_rigid = false;
  Table packings{{"state", "branch", "P*", "Φ", "z", "z+", "z−", "z0", "distant", "rattlers x0"}, {}};
  Table elasticity{{"state", "P*", "B Reuss", "B", "± B", "B Voigt", "G", "± G", "G Voigt", "isotropy defect",
                    "unstable", "bounds hold"},
                   {}};
  Table contacts{{"state", "P", "z of points", "z of pairs", "below the mean", "α", "β", "mobilised", "q/p",
                  "vertex-face", "edge-edge", "double", "face-face"},
                 {}};
  std::vector<std::string> warnings;
  /// Warnings, each with the numbers of the states to which it applies.
  std::map<std::string, std::vector<int>> state_warnings;
};

/// Returns the indices of three states of the first loading: the first (loosest) state, the last (densest) state, and
/// the state half way between them along the load path. If the path contains no loading, returns the index of the last
/// state only. For rigid grains, which may have no reduced pressure, returns the first, the middle and the last state
/// of the whole path.
/// @param is_rigid  whether the grains are rigid
std::set<std::size_t> shown_states(const PathTable& path, bool is_rigid) {
  std::set<std::size_t> shown;
  if (is_rigid) return {0, (path.rows.size() - 1) / 2, path.rows.size() - 1};
  const Loading loading = first_loading(path.rows);
  if (loading.rows.empty()) return {path.rows.size() - 1};
  const std::size_t last = loading.rows.size() - 1;
  for (const std::size_t k : {std::size_t{0}, last / 2, last})
    shown.insert(static_cast<std::size_t>(loading.rows[k]));
  return shown;
}

/// Adds a state of rigid grains to the tables of the report, with a description of its contacts instead of moduli.
template <int Dim>
void add_rigid_state(const std::string& file, const State<Dim>& state, ReportedRun<Dim>& run) {
  NetworkTableOptions options;
  options.mechanics = false;
  NetworkTables side;
  const NetworkRow row = network_row(file, state, options, side, {});
  const Packing<Dim>& packing = state.packing;
  const std::int64_t step = state.path.step;
  const Coordination& c = row.coordination;
  run.packings.columns[2] = "P";
  run.packings.rows.push_back({step, state.path.branch, state.target_stress.mean(), row.solid_fraction, c.z,
                               c.z_plus, c.z_minus, c.z_zero, std::int64_t{c.n_distant}, c.rattler_fraction});
  const ForceShape& forces = row.force_by_points;
  std::vector<TableValue> values = {
      step,
      state.target_stress.mean(),
      c.z,
      2.0 * static_cast<double>(n_touching_pairs(packing)) / packing.grains.size(),
      forces.below_mean,
      or_undefined(forces.alpha),
      or_undefined(forces.beta),
      or_undefined(row.mobilisation),
      row.anisotropy ? TableValue{row.anisotropy->stress_ratio} : TableValue{}};
  for (std::size_t k = 0; k < 4; ++k)
    values.push_back(row.kinds ? TableValue{row.kinds->share[k]} : TableValue{});
  run.contacts.rows.push_back(std::move(values));
}

template <int Dim>
void add_elastic_state(const State<Dim>& state, ReportedRun<Dim>& run) {
  const Packing<Dim>& packing = state.packing;
  ModuliOptions options;
  options.unloaded = state.target_stress.isZero(0.0);
  const Moduli m = elastic_moduli(packing, options);
  const Coordination counted =
      coordination(packing, state.tolerance.force * force_scale(packing, state.target_stress).force);
  const double P_star = reduced_pressure(packing, state.target_stress.mean());
  const std::int64_t step = state.path.step;
  run.moduli.push_back(moduli_point(P_star, m));
  run.moduli.back().is_driven = !state.path.turn.empty();
  if (run.moduli.back().is_driven)
    run.packings.columns[2] = run.elasticity.columns[1] = mean_pressure_label(true);
  run.packings.rows.push_back({step, state.path.branch, P_star, solid_fraction(packing), counted.z,
                               counted.z_plus, counted.z_minus, counted.z_zero, std::int64_t{counted.n_distant},
                               counted.rattler_fraction});
  run.elasticity.rows.push_back({step, P_star, m.bounds.B_reuss, m.B, m.B_error, m.bounds.B_voigt, m.G,
                                 m.G_error, m.bounds.G_voigt, m.isotropy_defect, std::int64_t{m.n_negative},
                                 m.bounds_hold()});
  for (const std::string& warning : m.warnings) run.state_warnings[warning].push_back(state.path.step);
}

/// Adds a state to the tables of the report.
/// @throws InputError if the grains are elastic and have walls
template <int Dim>
void add_state(const std::string& file, const State<Dim>& state, ReportedRun<Dim>& run) {
  if (state.packing.law.is_rigid()) {
    add_rigid_state(file, state, run);
  } else {
    require_periodic(state.packing, "a report of elastic grains is made", file);
    add_elastic_state(state, run);
  }
  if (state.motion) return;
  if (const std::string message = equilibrium_faults(state); !message.empty())
    run.state_warnings["not in equilibrium: " + message].push_back(state.path.step);
}

/// Unit of pressures and moduli of packings in reduced units, as text for HTML.
template <int Dim>
constexpr const char* kPressureUnit = Dim == 2 ? "F0/a" : "F0/a²";

bool is_rigid_state(const std::string& file) {
  return std::visit([](const auto& state) { return state.packing.law.is_rigid(); }, read_state(file));
}

/// Reads the table path.csv and all states of a run.
/// @throws InputError unless the table has one row per state and all states have the dimension Dim
template <int Dim>
ReportedRun<Dim> read_run(const std::string& directory) {
  ReportedRun<Dim> run;
  run.directory = directory;
  run.path = read_path(table_of_run(directory), {});
  run.files = states_of_run(directory);
  // Row k of path.csv must describe state file k, because shown_states() selects rows of the table and the loop below
  // reads the files with the same numbers. After an interrupted run, the numbers of rows and files may differ.
  if (run.files.size() != run.path.rows.size())
    throw InputError(directory,
                     fmt::format("this directory has {} state files, but its path.csv has {} rows: expected "
                                 "one row per state file (floc run --resume completes an unfinished run)",
                                 run.files.size(), run.path.rows.size()));
  // The kind of the contacts must be known before the loop over the states, because the choice of the shown states
  // depends on it.
  run.is_rigid = is_rigid_state(run.files.front());
  const std::set<std::size_t> shown = shown_states(run.path, run.is_rigid);
  for (std::size_t k = 0; k < run.files.size(); ++k) {
    const AnyState any = read_state(run.files[k]);
    const auto* found = std::get_if<State<Dim>>(&any);
    if (found == nullptr)
      throw InputError(
          run.files[k],
          fmt::format(
              "this state is not in {}D, but {} is: expected a directory with the states of a single run", Dim,
              run.files.front()));
    const State<Dim>& state = *found;
    if (state.packing.law.is_rigid() != run.is_rigid)
      throw InputError(run.files[k],
                       fmt::format("the contacts of this state are {}, but those of {} are not: expected a "
                                   "directory with the states of a single run",
                                   run.is_rigid ? "elastic" : "rigid", run.files.front()));
    add_state(run.files[k], state, run);
    if (k == 0) run.first = state;
    if (shown.contains(k)) run.shown.push_back(state), run.shown_files.push_back(run.files[k]);
  }
  return run;
}

template <int Dim>
std::string provenance_section(const ReportedRun<Dim>& run) {
  const State<Dim>& state = *run.first;
  Table table{{"", ""}, {}};
  const auto add = [&table](const char* name, const std::string& value) {
    table.rows.push_back({name, value});
  };
  add("program", state.provenance.program);
  add("commit", state.provenance.commit);
  add("compiler", state.provenance.compiler);
  if (!state.provenance.source.empty()) add("converted from", state.provenance.source);
  add("seed", fmt::format("{}", state.provenance.seed));
  add("contact law", law_text(state.packing.law));
  add("units", state.units);
  add("grains", fmt::format("{}", state.packing.grains.size()));
  add("states", fmt::format("{}", run.files.size()));
  add("SHA-256 of the scene", state.scene.empty() ? "–" : sha256(state.scene));
  add("SHA-256 of the last state", sha256_of_file(run.files.back()));
  return "<h2>Provenance</h2>\n" + html_table(table);
}

/// Returns the scene of a run, whose text is stored in the states of the run. If the run started from a saved state,
/// the scene names the file of that state, which may no longer exist. In the returned scene, this name is replaced by
/// the name of the first state of the run, which has the same grains.
template <int Dim>
Scene scene_of(const ReportedRun<Dim>& run) {
  std::vector<std::string> changes;
  if (run.first->path.step == 0 && !run.first->provenance.parent_sha256.empty())
    changes = {fmt::format("assembly.state=\"{}\"", fs::path(run.files.front()).filename().string()),
               fmt::format("assembly.state_sha256=\"{}\"", sha256_of_file(run.files.front())),
               Dim == 2 ? "assembly.copies=[1, 1]" : "assembly.copies=[1, 1, 1]"};
  return parse_scene(run.first->scene, "the scene", run.directory, changes);
}

template <int Dim>
std::string groups_section(ReportedRun<Dim>& run) {
  if (run.first->scene.empty()) return "";
  Table table{{"group", "value", "meaning"}, {}};
  try {
    for (const DerivedGroup& group : derived_groups(scene_of(run)))
      if (group.name != "cost") table.rows.push_back({group.name, group.value, group.meaning});
  } catch (const InputError& error) {
    run.warnings.push_back(std::string("the dimensionless groups are left out, because this version of floc "
                                       "cannot read the scene of the run: ") +
                           error.what());
    return "";
  }
  return "<h2>Dimensionless groups</h2>\n" + html_table(table);
}

const char* formula_of(ConsolidationLaw law) {
  switch (law) {
    case ConsolidationLaw::log:
      return "1/Φ = 1/Φ0 − λ ln(P*/P0*)";
    case ConsolidationLaw::power:
      return "1/Φ = 1/Φ_max + A (P*)^−α";
    case ConsolidationLaw::full:
      return "1/Φ = 1/Φ0 − λ ln{(P*/P0*) [1 − exp(−(P1*/P*)^α)]^(1/α)}";
  }
  return "";
}

template <int Dim>
std::string fit_section(const ConsolidationFit& fit, ReportedRun<Dim>& run) {
  for (const std::string& warning : fit.warnings)
    run.warnings.push_back("fit of the consolidation law: " + warning);
  if (!fit.found()) {
    run.warnings.push_back("the consolidation law cannot be fitted: " + fit.failure_reason);
    return "";
  }
  Table table{{"parameter", "value", "standard error", "95 % from", "to", "identified"}, {}};
  for (const FittedParameter& p : fit.parameters) {
    std::vector<TableValue> row = {p.name};
    for (TableValue& cell : parameter_cells(p)) row.push_back(std::move(cell));
    table.rows.push_back(std::move(row));
  }
  return fmt::format("<h2>Consolidation</h2>\n<p>{}, fitted to the ", formula_of(fit.law)) +
         "first loading. The errors are estimated from this sample alone and do not include the scatter "
         "between samples.</p>\n" +
         html_table(table);
}

template <int Dim>
std::vector<ForceSample> force_samples(const ReportedRun<Dim>& run) {
  std::vector<ForceSample> forces;
  for (std::size_t k = 0; k < run.shown.size(); ++k)
    forces.push_back(force_sample(run.shown_files[k], pressure_text(run.shown[k]), run.shown[k].packing,
                                  ForceKind::normal, ForceUnit::mean));
  return forces;
}

template <int Dim>
std::string plots_section(const FittedConsolidation& fitted, ReportedRun<Dim>& run) {
  std::string out = "<h2>Plots</h2>\n<div class=\"plots\">\n";
  const auto add = [&out](const Plot& plot, const std::string& caption) {
    out += html_figure(plot_as_svg(plot), caption);
  };
  if (run.is_rigid) {
    add(forces_plot(force_samples(run), ForceKind::normal, ForceUnit::mean),
        "Probability density of the normal forces of contact points, positive in compression.");
    return out + "</div>\n";
  }
  add(consolidation_plot({run.path}, fitted),
      "Consolidation curve with the fitted law, unloading branches and elastic lines.");
  const bool cohesive = run.first->packing.law.adheres();
  add(moduli_plot(run.moduli, stress_unit(run.first->units, Dim, cohesive)),
      "Bulk and shear moduli; bounds are shown for the states for which they hold.");
  add(coordination_plot(run.path.table),
      "Coordination number by the sign of the normal force; open symbols: unloading.");
  add(forces_plot(force_samples(run), ForceKind::normal, ForceUnit::mean),
      "Probability density of the normal forces, positive in compression.");
  // the scattering of grains with corners is not known
  if (!run.first->packing.grains.are_round()) return out + "</div>\n";
  std::vector<ScatteringSample> scattering;
  for (std::size_t k = 0; k < run.shown.size(); ++k) {
    const std::string name = pressure_text(run.shown[k]);
    scattering.push_back(scattering_sample(name, run.shown[k].packing));
    if (!scattering.back().failure_reason.empty())
      run.warnings.push_back("I(k) at " + name +
                             ": the law of fractal aggregates is not drawn, because it cannot be fitted: " +
                             scattering.back().failure_reason);
  }
  add(scattering_plot(scattering),
      "Scattered intensity I(k) of the grains, and the fitted law of fractal aggregates.");
  return out + "</div>\n";
}

template <int Dim>
std::string pictures_section(const ReportedRun<Dim>& run) {
  std::string out = "<h2>Force networks</h2>\n";
  for (std::size_t k = 0; k < run.shown.size(); ++k) {
    const bool round = run.shown[k].packing.grains.are_round();
    const Shown shown = round ? Shown::equilibrium : Shown::kinds;
    out += html_figure(
        draw_sheet<Dim>({picture_of(run.shown_files[k], run.shown[k], shown)}, {}),
        "Forces at " + pressure_text(run.shown[k]) + ", " + fs::path(run.shown_files[k]).filename().string() +
            (round
                 ? ": lines join the centres of grains that interact; their width is proportional to the force."
                 : ": lines join the centres of grains that interact, coloured by the kind of contact (such as "
                   "vertex and face); their width is proportional to the force."));
  }
  return out;
}

template <int Dim>
std::string warnings_section(const ReportedRun<Dim>& run) {
  std::string out = "<h2>Warnings</h2>\n";
  if (run.warnings.empty() && run.state_warnings.empty()) return out + "<p>None.</p>\n";
  out += "<ul class=\"warnings\">\n";
  for (const auto& [message, steps] : run.state_warnings)
    out += html_text(fmt::format("state{} {}: {}", steps.size() == 1 ? "" : "s", ranges(steps), message), "li");
  for (const std::string& warning : run.warnings) out += html_text(warning, "li");
  return out + "</ul>\n";
}

template <int Dim>
std::string moduli_section(const ReportedRun<Dim>& run) {
  const std::string unit = stress_unit(run.first->units, Dim, run.first->packing.law.adheres());
  return "<h2>Moduli</h2>\n<p>In " +
         (unit == "F_0/a" || unit == "F_0/a^2" ? kPressureUnit<Dim> : html_text(unit)) +
         "; ± gives an upper bound of the numerical error.</p>\n" + html_table(run.elasticity);
}

template <int Dim>
std::string grains_in_words(const Packing<Dim>& packing) {
  if (packing.grains.are_round()) return Dim == 2 ? "disks" : "spheres";
  return Dim == 2 ? "polygons" : "polyhedra";
}

template <int Dim>
std::string page_of(ReportedRun<Dim>& run) {
  const FittedConsolidation fitted = run.is_rigid ? FittedConsolidation{} : fitted_consolidation({run.path});
  const std::string title = "floc report: " + fs::path(run.directory).lexically_normal().string();
  const State<Dim>& dense = run.shown.back();
  const std::string groups = groups_section(run),
                    fit = run.is_rigid ? std::string() : fit_section(fitted.fit, run),
                    plots = plots_section(fitted, run);
  std::string body = "<h1>" + html_text(title) + "</h1>\n";
  body += html_text(fmt::format("{} {}, {} {}, up to {} at a solid fraction of Φ = {:.4f}.",
                                dense.packing.grains.size(), grains_in_words(dense.packing), run.files.size(),
                                dense.motion ? "states" : "equilibrium states", pressure_text(dense),
                                solid_fraction(dense.packing)));
  body += warnings_section(run) + pictures_section(run) + plots + fit;
  body += "<h2>States</h2>\n" + html_table(run.packings);
  body += run.is_rigid ? "<h2>Contacts</h2>\n" + html_table(run.contacts) : moduli_section(run);
  body += groups + provenance_section(run);
  if (!run.first->scene.empty()) body += "<h2>Scene</h2>\n<pre>" + html_text(run.first->scene) + "</pre>\n";
  return html_page(title, body);
}

template <int Dim>
int report_of(const ReportArguments& arguments) {
  ReportedRun<Dim> run = read_run<Dim>(arguments.directory);
  const std::string page = page_of(run);
  write_output(arguments.output, page);
  print_table({{"run", "report", "n_states", "n_warnings", "bytes"},
               {{arguments.directory, arguments.output, static_cast<std::int64_t>(run.files.size()),
                 static_cast<std::int64_t>(run.warnings.size() + run.state_warnings.size()),
                 static_cast<std::int64_t>(page.size())}}},
              arguments.printing);
  return kDone;
}

int report(const ReportArguments& arguments) {
  // table_of_run() throws an InputError if the directory belongs to an ensemble; the message names one sample of the
  // ensemble.
  table_of_run(arguments.directory);
  const AnyState first = read_state(states_of_run(arguments.directory).front());
  return std::holds_alternative<State<2>>(first) ? report_of<2>(arguments) : report_of<3>(arguments);
}

}  // namespace

Command add_report(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "report", "Write a report of a run as one self-contained HTML page: pictures, plots, tables, scene");
  const auto arguments = std::make_shared<ReportArguments>();
  app.add_option("DIR", arguments->directory, "directory of floc run").required();
  app.add_option("-o,--output", arguments->output, "HTML file to write, such as F.html").required();
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return report(*arguments); }};
}

}  // namespace floc
