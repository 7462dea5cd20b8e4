#include "floc/scene/read_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "floc/assembly/gas.h"
#include "floc/base/error.h"
#include "floc/base/read_text.h"
#include "floc/contact/law_description.h"
#include "floc/prices/numerical_settings.h"
#include "floc/scene/cell_defaults.h"
#include "floc/scene/check_masses.h"
#include "floc/scene/check_resolution.h"
#include "floc/scene/check_softening.h"
#include "floc/scene/check_time_steps.h"
#include "floc/scene/read_accuracy.h"
#include "floc/scene/read_box.h"
#include "floc/scene/read_diameters.h"
#include "floc/scene/read_dynamics.h"
#include "floc/scene/read_law.h"
#include "floc/scene/read_load.h"
#include "floc/scene/read_saved_start.h"
#include "floc/scene/read_shape.h"
#include "floc/scene/scene_prices.h"
#include "floc/scene/table_reader.h"

namespace floc {
namespace {

using Need = TableReader::Need;

constexpr bool is_gas_of_disks(double x) {
  return x > 0 && x <= kDensestGasOfDisks;
}
constexpr bool is_gas_of_spheres(double x) {
  return x > 0 && x <= kDensestGasOfSpheres;
}
/// Whether a time step is stable for any grains (see RelaxationOptions::time_step).
/// @param x  time step in units of sqrt(m_min/K_N), with the mass m_min of the smallest grain and the normal stiffness
/// K_N
constexpr bool is_stable_step(double x) {
  return x > 0 && x < kStableStep;
}

void read_scene_table(TableReader& root, Scene& scene) {
  TableReader t = root.table("scene", "a table [scene]");
  scene.name = t.text("name", "a string", Need::optional).value_or(scene.name);
  scene.dimension = static_cast<int>(t.integer("dimension", {2, 3, "2 or 3"}).value_or(2));
  const std::vector<std::string> units = {"reduced", "SI"};
  if (const auto chosen = t.choice("units", units)) scene.units = units[*chosen];
  t.refuse_other_keys();
}

void read_grains(TableReader& root, SceneSource& source, const std::string& directory, Scene& scene) {
  if (scene.starts_from_state())
    return root.refuse("grains", "[grains] is not allowed here: the grains come from the file assembly.state");
  TableReader t = root.table("grains", "a table [grains]");
  const auto count = t.integer(
      "count",
      {2, kMaxGrains, "the number of grains, a whole number from 2 to 1e8 written without an exponent"});
  scene.grains.count = static_cast<int>(count.value_or(0));
  scene.grains.density =
      t.number("density", {positive, "a positive number (mass per area in 2D, mass per volume in 3D)"},
               scene.units == "SI" ? Need::required : Need::optional);
  scene.grains.diameter =
      read_diameters(t.table("diameter", "a table, e.g. {distribution = \"uniform\", min = 0.5, max = 1.0}"),
                     source, directory, scene.dimension, scene.units);
  scene.grains.shape = read_shape(t, source, directory);
  const std::size_t listed = scene.grains.diameter.values.size();
  if (listed > 0 && count && listed != static_cast<std::size_t>(*count))
    t.fault("count", fmt::format("grains.count = {}: expected {}, which is the number of diameters in the list",
                                 *count, listed));
  t.refuse_other_keys();
}

/// Reads the table [cell] of a scene with a periodic cell.
/// @return default mass of the cell and default caps on its strain rate on the load path, without the values that
/// [cell] itself gives
CellResponse read_cell(TableReader& root, Scene& scene) {
  const bool from_state = scene.starts_from_state();
  TableReader t = root.table("cell", "a table [cell]", from_state ? Need::optional : Need::required);
  if (from_state)
    t.refuse("solid_fraction",
             "cell.solid_fraction is not allowed here: the cell comes from the file assembly.state");
  else
    scene.assembly.solid_fraction =
        t.number("solid_fraction",
                 scene.dimension == 2
                     ? NumberRule{is_gas_of_disks,
                                  "the solid fraction of the gas in (0, 0.6]; at larger solid fractions grains "
                                  "cannot be placed at random without overlap"}
                     : NumberRule{is_gas_of_spheres,
                                  "the solid fraction of the gas in (0, 0.49]; at larger solid fractions "
                                  "spheres cannot be placed at random without overlap"})
            .value_or(0);
  CellResponse said = read_rate_caps(t);
  said.cell_mass = t.number("mass", kCellMass, Need::optional);
  t.refuse_other_keys();
  CellResponse assembling = default_cap(scene);
  assembling.cell_mass = kAssemblyCellMass;
  scene.relaxation = said.or_else(assembling).applied_to(scene.relaxation);
  CellResponse unsaid = default_load_response(scene);
  if (said.has_cap()) unsaid.strain_rate_cap = unsaid.inertial_number_cap = std::nullopt;
  if (said.cell_mass) unsaid.cell_mass.reset();
  // If the run starts from a saved packing that is not vibrated, the assembly only brings the packing to its first
  // pressure. The cell then moves as it does on the load path.
  if (from_state && !scene.assembly.vibration) scene.assembly.cell = scene.assembly.cell.or_else(unsaid);
  return unsaid;
}

/// Whether a scene has walls. A scene has either a table [box] (walls) or a table [cell] (periodic cell).
bool has_box(const TableReader& root) {
  return root.has("box");
}

/// Reads the table assembly.vibration, which describes the vibration of a packing before its compression.
/// @param assembly  table [assembly]
std::optional<Vibration> read_vibration(TableReader& assembly) {
  if (!assembly.has("vibration")) return std::nullopt;
  TableReader t = assembly.table("vibration", "a table with two numbers, {dilation, collisions}");
  Vibration vibration;
  vibration.dilation = t.number("dilation", {[](double x) { return x >= 1 && x <= 2; },
                                             "the factor by which all lengths grow, a number from 1 to 2"})
                           .value_or(1);
  vibration.collisions =
      t.number("collisions", {[](double x) { return x > 0 && x <= 1e6; },
                              "the number of collisions per grain, a positive number up to 1e6"})
          .value_or(1);
  t.refuse_other_keys();
  return vibration;
}

void read_assembly(TableReader& root, const std::string& directory, Scene& scene) {
  TableReader t = root.table("assembly", "a table [assembly]");
  using Protocol = AssemblyOptions::Protocol;
  const auto protocol = t.choice("protocol", {"direct", "aggregation", "state"});
  scene.assembly.protocol =
      std::array{Protocol::direct, Protocol::aggregation, Protocol::state}[protocol.value_or(0)];
  if (scene.law.is_rigid()) scene.assembly.gas = GasKind::sequential_addition;
  if (scene.starts_from_state())
    t.refuse("gas", "assembly.gas is not allowed here: the grains come from the file assembly.state");
  else if (const auto gas = t.choice("gas", {"equilibrated", "sequential_addition"}, Need::optional))
    scene.assembly.gas = std::array{GasKind::equilibrated, GasKind::sequential_addition}[*gas];
  // In a scene with walls, the pressure on the walls (box.pressure) acts from the start. Keys about a periodic cell are
  // not allowed.
  const bool boxed = has_box(root);
  if (boxed) {
    read_boxed_gas(t, scene);
  } else {
    // If no pressure is given, a saved packing keeps its stresses.
    scene.assembly.pressure =
        t.number("pressure",
                 {positive, "a positive number (first pressure of the packing, compression positive)"},
                 scene.starts_from_state() ? Need::optional : Need::required)
            .value_or(0);
    for (const char* key : {"kinetic_pressure", "solid_fraction"})
      t.refuse(key, fmt::format("assembly.{} is not allowed here: it describes the gas between walls, but the "
                                "scene has no table [box]",
                                key));
  }
  const NumberRule agitation{
      positive,
      "a positive number (speed of the grains at the start, in units of sqrt(F0 D0/m) with "
      "the pull-off force F0, the range D0 of the adhesion and the largest mass m)"};
  // The key "agitation" gives the speed of the grains at the start. The protocol "aggregation" requires this key,
  // because the motion brings the grains into contact. The key is not allowed for cohesive grains that are compressed
  // directly.
  const bool aggregates = scene.assembly.protocol == Protocol::aggregation;
  if (boxed && aggregates)
    t.fault("protocol",
            "assembly.protocol = \"aggregation\": in a scene with a table [box] the pressure acts from the "
            "start; expected \"direct\" or \"state\"");
  if (boxed)
    t.refuse("agitation",
             "assembly.agitation is not allowed here: in a scene with a table [box] assembly.kinetic_pressure "
             "gives the speed of the grains");
  else if (protocol && scene.assembly.protocol == Protocol::direct && scene.law.has_adhesion())
    t.refuse("agitation",
             "assembly.agitation is not allowed here: with protocol = \"direct\" cohesive grains start at "
             "rest; expected protocol = \"aggregation\", or remove the key");
  else
    scene.assembly.agitation =
        t.number("agitation", agitation,
                 (aggregates && !scene.law.is_rigid()) || !protocol ? Need::required : Need::optional)
            .value_or(0);
  if (scene.law.has_friction())
    scene.assembly.friction =
        t.number("friction", {not_negative, "the friction coefficient during the assembly, a number >= 0"},
                 Need::optional);
  else
    t.refuse("friction",
             "assembly.friction is not allowed here: the contact law has no friction; expected a table "
             "contact.friction, or remove the key");
  scene.assembly.cell = read_cell_response(t, boxed);
  if (boxed)
    t.refuse("vibration",
             "assembly.vibration is not allowed here: only packings in a periodic cell can be vibrated, but "
             "the scene has walls");
  else if (aggregates)
    t.refuse(
        "vibration",
        "assembly.vibration is not allowed here: expected assembly.protocol = \"direct\" or \"state\", or no "
        "key vibration");
  else
    scene.assembly.vibration = read_vibration(t);
  if (scene.starts_from_state()) {
    read_saved_start(t, directory, scene);
  } else {
    for (const char* key : {"state", "copies", "state_sha256"})
      t.refuse(key,
               fmt::format("assembly.{} is not allowed here: expected protocol = \"state\", or remove the key",
                           key));
  }
  t.refuse_other_keys();
}

void read_equilibrium(TableReader& root, Scene& scene) {
  RelaxationOptions& relaxation = scene.relaxation;
  TableReader t = root.table("equilibrium", "a table [equilibrium]", Need::optional);
  // This call comes first, because it sets the default tolerance of the stress for packings between walls. A value of
  // the key stress replaces this default below.
  read_compaction_end(t, scene);
  const NumberRule rule{positive, "a positive number (tolerance)"};
  EquilibriumTolerance& tolerance = relaxation.tolerance;
  tolerance.force = t.number("force", rule, Need::optional).value_or(tolerance.force);
  tolerance.moment = t.number("moment", rule, Need::optional).value_or(tolerance.moment);
  tolerance.stress = t.number("stress", rule, Need::optional).value_or(tolerance.stress);
  tolerance.energy = t.number("energy", rule, Need::optional).value_or(tolerance.energy);
  const std::array kFinishes = {Finish::automatic, Finish::dynamic, Finish::statics};
  const auto finish =
      t.choice("finish", {finish_name(kFinishes[0]), finish_name(kFinishes[1]), finish_name(kFinishes[2])},
               Need::optional);
  relaxation.max_time =
      t.number("max_time",
               {positive,
                "a positive number (time in units of sqrt(a m/F1) with the largest diameter a, "
                "its mass m and the typical force F1)"},
               Need::optional)
          .value_or(relaxation.max_time);
  relaxation.patience =
      t.number("patience",
               {positive,
                "a positive number, which multiplies the time during which a packing must not "
                "move before it counts as at rest"},
               Need::optional)
          .value_or(relaxation.patience);
  relaxation.finish = kFinishes[finish.value_or(0)];
  relaxation.equal_masses =
      t.choice("masses", {masses_name(false), masses_name(true)}, Need::optional).value_or(0) == 1;
  relaxation.softening = t.number("softening", kSoftening, Need::optional).value_or(relaxation.softening);
  t.refuse_other_keys();
}

void read_run(TableReader& root, Scene& scene) {
  TableReader t = root.table("run", "a table [run]", Need::optional);
  const auto seed =
      t.integer("seed", {0, std::numeric_limits<std::int64_t>::max(), "a whole number >= 0"}, Need::optional);
  scene.seed = static_cast<std::uint64_t>(seed.value_or(static_cast<std::int64_t>(scene.seed)));
  const auto threads = t.integer("threads",
                                 {RunOptions::kThreads.least, RunOptions::kThreads.most,
                                  "the number of threads, a whole number from 1 to 1024"},
                                 Need::optional);
  scene.relaxation.threads = static_cast<int>(threads.value_or(scene.relaxation.threads));
  scene.relaxation.time_step =
      t.number(
           "time_step",
           {is_stable_step,
            "a number in (0, 0.4) (time step in units of sqrt(m_min/K) with the smallest mass m_min and the "
            "contact stiffness K; larger time steps are unstable)"},
           Need::optional)
          .value_or(scene.relaxation.time_step);
  scene.relaxation.skin = t.number(
      "skin", {positive, "a positive number (length in units of the largest diameter)"}, Need::optional);
  scene.checkpoint_every =
      t.number("checkpoint_every", {positive, "a positive number (wall time in seconds)"}, Need::optional)
          .value_or(scene.checkpoint_every);
  t.refuse_other_keys();
}

/// Records faults for tables of a scene that contradict each other.
void check_consistency(TableReader& root, SceneSource& source, const Scene& scene) {
  const bool cohesive = scene.law.has_adhesion() || source.is_faulty("contact.adhesion.law");
  TableReader contact = root.table("contact", "", Need::optional);
  TableReader cell = root.table("cell", "", Need::optional);
  TableReader assembly = root.table("assembly", "", Need::optional);
  if (!contact) return;
  for (TableReader* t : {&cell, &assembly})
    if (t->has("strain_rate_cap") && !t->has("inertial_number_cap") && !cohesive)
      t->fault("strain_rate_cap",
               fmt::format("{} is not allowed here: its unit 1/T0, with T0 = sqrt(a m/F0), requires a pull-off "
                           "force F0, but the grains do not adhere; expected inertial_number_cap",
                           t->path_of("strain_rate_cap")));
  // For rigid grains, check_rigid() reports the protocol "aggregation" with another message.
  if (scene.assembly.protocol != AssemblyOptions::Protocol::aggregation || scene.law.is_rigid()) return;
  if (!cohesive || (scene.law.has_adhesion() && scene.law.range() == 0))
    assembly.fault(
        "protocol",
        "assembly.protocol = \"aggregation\": grains stick to each other only by an adhesion that acts across "
        "a gap; expected contact.adhesion = {law = \"tail\", force, range}, or protocol = \"direct\"");
  constexpr const char* kNothingMoves =
      "{}: the protocol \"aggregation\" makes an equilibrium at zero pressure, where a cap on the inertial "
      "number allows no motion; expected cell.strain_rate_cap in its place";
  if (cell.has("inertial_number_cap") && !cell.has("strain_rate_cap"))
    cell.fault("inertial_number_cap", fmt::format(kNothingMoves, "cell.inertial_number_cap"));
  if (assembly.has("inertial_number_cap"))
    assembly.fault("inertial_number_cap", fmt::format(kNothingMoves, "assembly.inertial_number_cap"));
}

/// If the TOML tables of a scene name a file of diameters or sieves, replaces this name by the content of the file.
/// Afterwards, the text of the scene is complete.
/// @param root  root table of the scene
/// @return whether the scene names such a file
bool inline_diameters(toml::table& root, const DiameterDistribution& d) {
  toml::table* diameter = root["grains"]["diameter"].as_table();
  if (!diameter || !diameter->contains("file")) return false;
  const auto insert = [&](const char* key, const std::vector<double>& values) {
    toml::array array;
    for (const double v : values) array.push_back(v);
    diameter->insert(key, array);
  };
  if (d.kind == DiameterDistribution::Kind::sieve) {
    insert("sizes", d.curve.sizes);
    insert("passing", d.curve.passing);
    // The sizes of the curve have already been multiplied by the scale, and the curve has been cut off at min and max.
    for (const char* key : {"scale", "min", "max"}) diameter->erase(key);
  } else {
    insert("values", d.values);
  }
  diameter->erase("file");
  return true;
}

/// Writes the SHA-256 checksum of the file of shapes into the TOML tables of a scene.
/// @param root  root table of the scene
/// @return whether the checksum was written; it is not written if no such file is given or if the checksum is present
/// already
bool name_shape_file(toml::table& root, const Scene& scene) {
  const auto* file = scene.grains.shape ? std::get_if<FileShapeOptions>(&scene.grains.shape->kind) : nullptr;
  return file && root["grains"]["shape"].as_table()->insert("sha256", file->sha256).second;
}

/// Writes the SHA-256 checksum of the state file from which the run starts into the TOML tables of a scene.
/// @param root  root table of the scene
/// @return whether the checksum was written; it is not written if no state file is given or if the checksum is present
/// already
bool name_state(toml::table& root, const Scene& scene) {
  return scene.starts_from_state() &&
         root["assembly"].as_table()->insert("state_sha256", scene.assembly.saved.sha256).second;
}

std::string as_text(const toml::table& root) {
  std::ostringstream out;
  out << root << '\n';
  return out.str();
}

/// Refuses a table of prices that is not valid or does not apply to a scene, even if the scene does not use it.
/// @param prices  file of the table; empty if the user has given none
void require_prices(const std::string& prices, const Scene& scene) {
  if (prices.empty()) return;
  if (const ScenePrices found = prices_of(scene, prices); !found.table) throw InputError(prices, found.problem);
}

}  // namespace

std::optional<Scene> scene_of_state(const std::string& text, const std::string& file, std::string& why_not) {
  const std::filesystem::path own = std::filesystem::path(file).parent_path();
  std::string reason;
  for (const std::filesystem::path& folder : {own, own / "..", own / ".." / ".."}) {
    try {
      return parse_scene(text, "its scene", folder.string());
    } catch (const InputError& error) {
      if (reason.empty()) reason = error.what();
    }
  }
  why_not = reason;
  return std::nullopt;
}

Scene parse_scene(const std::string& text, const std::string& place, const std::string& directory,
                  const std::vector<std::string>& overrides, const std::string& prices) {
  SceneSource source(text, place, overrides);
  TableReader root(source);
  Scene scene;
  scene.name = std::filesystem::path(place).stem().string();
  read_scene_table(root, scene);
  scene.law = read_law(root, scene.dimension);
  read_assembly(root, directory, scene);
  read_grains(root, source, directory, scene);
  if (scene.grains.shape && !root.table("assembly", "", Need::optional).has("gas"))
    scene.assembly.gas = GasKind::sequential_addition;
  CellResponse unsaid;
  if (has_box(root)) {
    read_box(root, scene);
    // The default cap on the strain rate also applies to walls in contact dynamics: a drag acts on these walls, as on
    // the sides of a periodic cell.
    if (scene.has_contact_dynamics()) scene.relaxation = default_cap(scene).applied_to(scene.relaxation);
    root.refuse(
        "cell",
        "[cell] is not allowed together with [box]: expected either a periodic cell ([cell]) or walls ([box])");
  } else {
    unsaid = read_cell(root, scene);
  }
  read_load(root, unsaid, scene);
  read_equilibrium(root, scene);
  read_run(root, scene);
  read_dynamics(root, source, scene);
  check_consistency(root, source, scene);
  check_rigid(root, source, scene);
  const bool has_chosen = read_accuracy(root, source, prices, scene);
  check_resolution(root, scene);
  check_softening(root, source, scene);
  check_masses(root, scene);
  check_time_steps(root, source, scene);
  check_shapes(root, source, scene);
  root.refuse_other_keys();
  source.throw_faults();
  require_prices(prices, scene);
  const bool has_list = inline_diameters(source.root(), scene.grains.diameter);
  const bool has_state = name_state(source.root(), scene);
  const bool has_shape_file = name_shape_file(source.root(), scene);
  scene.text = has_list || has_state || has_shape_file || has_chosen || !overrides.empty()
                   ? as_text(source.root())
                   : text;
  return scene;
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides,
                 const std::string& prices) {
  const auto refuse = [&path](const char* why) {
    throw InputError(path, fmt::format("{}; expected a scene file (TOML)", why));
  };
  if (std::filesystem::is_directory(path)) refuse("this is a directory");
  if (path != "-" && !std::filesystem::exists(path)) refuse("there is no such file");
  const std::string text = read_text(path);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) refuse("this file is empty");
  return parse_scene(text, path, std::filesystem::path(path).parent_path().string(), overrides, prices);
}

}  // namespace floc
