#include "floc/scene/read_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"
#include "floc/loading/run_plan.h"

namespace floc {
namespace {

using Need = TableReader::Need;

constexpr bool is_steps_per_decade(double x) {
  return x > 0 && x <= 1000;
}
/// Largest logarithmic strain. At 2 a side has 0.14 of its length; beyond, the cell would close.
constexpr double kLargestStrain = 2.0;
constexpr bool is_strain(double x) {
  return x >= -kLargestStrain && x <= kLargestStrain;
}
constexpr std::int64_t kMaxSteps = 10'000;
constexpr double kRoundingPerStep = 1e-6;

constexpr NumberRule kStrain{is_strain,
                             "a logarithmic strain from -2 to 2 (compression positive; beyond, the cell would "
                             "close)"};
/// Largest shear strain: beyond it a sheared packing has long been in a steady state.
constexpr NumberRule kShear{[](double x) { return x >= -100 && x <= 100; }, "a shear strain from -100 to 100"};
const std::vector<std::string> kControls = {"isotropic",       "oedometric", "triaxial",
                                            "constant_volume", "axes",       "simple_shear"};

std::vector<std::string> law_keys(LawParameters law) {
  std::vector<std::string> keys;
  for (const LawNumber& n : numbers_of(law)) keys.push_back(n.key);
  return keys;
}

/// Applies the changes of a stage to the present law, and records their faults.
void apply_changes(TableReader& t, const LoadStage& stage, Law& present) {
  LawParameters law = present;
  for (const auto& [key, value] : stage.set) {
    double* number = law_number(law, key);
    if (!number) {
      t.fault("set",
              fmt::format("{}.set.{}: the scene's contact law has no such parameter; the nearest it has is {}",
                          t.path(), key, nearest_key(key, law_keys(law))));
      present = law;
      return;
    }
    *number = value;
  }
  for (const std::string& fault : stage.set.empty() ? std::vector<std::string>{} : law.validate())
    t.fault("set", fmt::format("{}.set: {}", t.path(), fault));
  present = law;
}

/// Reads the stress or strain at the end of a stage of one axis.
/// @param of_stress  key of the stress and its requirement
AxisLoad read_axis_load(TableReader& t, const char* stress_key, const char* of_stress) {
  const bool has_stress = t.has(stress_key);
  const auto stress = t.number(stress_key, {not_negative, of_stress}, Need::optional);
  const auto strain = t.number("strain", kStrain, Need::optional);
  if (has_stress && t.has("strain"))
    t.fault("strain", fmt::format("{}: expected either this or {}, not both", t.path_of("strain"), stress_key));
  else if (t && !has_stress && !t.has("strain"))
    t.fault(stress_key, fmt::format("{} is missing: give {} or strain", t.path_of(stress_key), stress_key));
  if (strain) return {AxisLoad::strain, *strain};
  return {AxisLoad::stress, stress.value_or(0.0)};
}

/// Reads `axes = [{stress = ..}, {strain = ..}, {as = 1}]`.
std::vector<AxisLoad> read_axes(TableReader& t, int dimension) {
  std::vector<AxisLoad> axes;
  const char* expectation = "an array of one table per axis, {stress = ..}, {strain = ..} or {as = 1}";
  std::vector<TableReader> tables = t.tables("axes", expectation);
  if (t && (!t.has("axes") || static_cast<int>(tables.size()) != dimension))
    t.fault("axes",
            fmt::format(
                "{} has {} tables: expected {}, one per axis, {{stress = ..}}, {{strain = ..}} or {{as = 1}}",
                t.path_of("axes"), tables.size(), dimension));
  for (TableReader& axis : tables) {
    const auto as = axis.integer("as", {1, 3, "the number of an axis before this one"}, Need::optional);
    const bool known = as && *as <= static_cast<std::int64_t>(axes.size());
    if (as && !known)
      axis.fault("as", fmt::format("{} = {}: expected the number of an axis before this one",
                                   axis.path_of("as"), *as));
    if (as)
      axes.push_back(known ? axes[static_cast<std::size_t>(*as - 1)] : AxisLoad{});
    else
      axes.push_back(read_axis_load(axis, "stress", "a stress >= 0 (compression positive)"));
    axis.refuse_other_keys();
  }
  return axes;
}

/// Returns the loads on the axes of a test in which one axis is driven.
std::vector<AxisLoad> read_test(TableReader& t, const std::string& control, int axis, int dimension) {
  if (control == "constant_volume" && t.has("to"))
    t.fault("to", fmt::format("{}: at constant volume the driven axis is given a length; expected strain",
                              t.path_of("to")));
  const AxisLoad driven = read_axis_load(t, "to", "a stress >= 0 (compression positive)");
  AxisLoad other{AxisLoad::kept_stress, 0.0};
  if (control == "oedometric") other = {AxisLoad::strain, 0.0};
  if (control == "constant_volume") other = {AxisLoad::strain, -driven.end / (dimension - 1)};
  std::vector<AxisLoad> axes(static_cast<std::size_t>(dimension), other);
  axes[static_cast<std::size_t>(axis)] = driven;
  return axes;
}

/// Reads a simple shear: the planes across an axis, which keeps its stress, move along the first axis. The lengths of
/// all other axes are kept.
void read_shear(TableReader& t, int dimension, LoadStage& stage) {
  const char* which = dimension == 2
                          ? "the number of the axis across whose planes the lattice is sheared, 2"
                          : "the number of the axis across whose planes the lattice is sheared, 2 or 3";
  if (const auto axis = t.integer("axis", {2, dimension, which}, Need::optional))
    stage.axis = static_cast<int>(*axis) - 1;
  t.refuse("to", fmt::format("{}: the lattice is sheared by a strain at the stress it has; expected strain",
                             t.path_of("to")));
  stage.shear = t.number("strain", kShear).value_or(0.0);
  stage.axes.assign(static_cast<std::size_t>(dimension), {AxisLoad::strain, 0.0});
  stage.axes[static_cast<std::size_t>(stage.axis)] = {AxisLoad::kept_stress, 0.0};
}

void read_axes_of(TableReader& t, int dimension, LoadStage& stage) {
  stage.axis = dimension - 1;
  if (stage.control == "axes") {
    stage.axes = read_axes(t, dimension);
    for (const char* key : {"to", "strain", "axis"})
      t.refuse(key,
               fmt::format(
                   "{} is not allowed with control = \"axes\": the tables of axes say what is imposed on each "
                   "axis",
                   t.path_of(key)));
    return;
  }
  t.refuse("axes", fmt::format("{}: expected control = \"axes\", or no such key", t.path_of("axes")));
  if (stage.control == "simple_shear") return read_shear(t, dimension, stage);
  const char* which =
      dimension == 2 ? "the number of the driven axis, 1 or 2" : "the number of the driven axis, 1 to 3";
  if (const auto axis = t.integer("axis", {1, dimension, which}, Need::optional))
    stage.axis = static_cast<int>(*axis) - 1;
  stage.axes = read_test(t, stage.control, stage.axis, dimension);
}

double largest_strain(const LoadStage& stage) {
  double largest = std::abs(stage.shear);
  for (const AxisLoad& axis : stage.axes)
    if (axis.kind == AxisLoad::strain) largest = std::max(largest, std::abs(axis.end));
  return largest;
}

/// Whether steps_per_decade determines the number of steps of a stage, which requires that its stresses start from
/// known ones above zero.
bool counts_in_decades(const KnownStress& from, const LoadStage& stage) {
  bool any = false;
  for (std::size_t a = 0; a < std::min(from.size(), stage.axes.size()); ++a) {
    if (stage.axes[a].kind != AxisLoad::stress) continue;
    if (!(from[a].value_or(0.0) > 0.0 && stage.axes[a].end > 0.0)) return false;
    any = true;
  }
  return any;
}

/// Reads the number of steps of a stage whose axes are loaded differently.
void read_step_size(TableReader& t, const KnownStress& from, LoadStage& stage) {
  const auto strain_step =
      t.number("strain_step", {positive, "a positive strain, of one step"}, Need::optional);
  const double strain = largest_strain(stage);
  const int given = (stage.steps ? 1 : 0) + (stage.steps_per_decade ? 1 : 0) + (strain_step ? 1 : 0);
  if (given > 1)
    t.fault("steps", fmt::format("{}: expected one of steps, strain_step and steps_per_decade",
                                 t.path_of(strain_step ? "strain_step" : "steps")));
  if (strain_step && strain == 0.0)
    t.fault("strain_step", fmt::format("{}: no axis is strained; expected steps or steps_per_decade",
                                       t.path_of("strain_step")));
  if (strain_step && strain > 0.0) {
    // An exact multiple of strain_step must not get one step more because of rounding.
    const double n = std::ceil(strain / *strain_step - kRoundingPerStep);
    if (n > static_cast<double>(kMaxSteps))
      t.fault("strain_step", fmt::format("{} = {}: {} steps to a strain of {}, expected at most {}",
                                         t.path_of("strain_step"), *strain_step, n, strain, kMaxSteps));
    else
      stage.steps = std::max(1, static_cast<int>(n));
  }
  // Steps per decade need the ratio of the last stress to the first one, so both must be known and positive.
  if (stage.steps_per_decade && !counts_in_decades(from, stage))
    t.fault("steps_per_decade",
            fmt::format("{}: the stress that the stage starts from is not known before the run, or zero; "
                        "expected steps{}",
                        t.path_of("steps_per_decade"), strain > 0.0 ? " or strain_step" : ""));
  if (given == 0 && t)
    t.fault("steps", fmt::format("{} is missing: give steps{}", t.path_of("steps"),
                                 strain > 0.0 ? " or strain_step" : " or steps_per_decade"));
}

/// Checks the number of steps of a stage that ends at the same pressure on every axis.
void check_isotropic_steps(TableReader& t, const KnownStress& from, bool has_end, const LoadStage& stage) {
  const bool by_decade = t.has("steps_per_decade");
  const bool by_number = t.has("steps");
  if (by_decade && by_number)
    t.fault("steps", fmt::format("{}: expected either this or steps_per_decade, not both", t.path_of("steps")));
  const bool is_one_step =
      is_isotropic(from) && (stage.to == from.front() || stage.to == 0 || from.front() == 0.0);
  if (has_end && !by_decade && !by_number && !is_one_step)
    t.fault("steps",
            fmt::format("{} is missing: give steps_per_decade or steps", t.path_of("steps_per_decade")));
  if (by_decade && std::any_of(from.begin(), from.end(), [](const auto& s) { return !s.has_value(); }))
    t.fault("steps_per_decade", fmt::format("{}: the stresses that the stage starts from are not known before "
                                            "the run; expected steps",
                                            t.path_of("steps_per_decade")));
}

/// Returns "load", "unload" or "hold" if the stress before is known, otherwise the kind of the test.
std::string default_name(const KnownStress& from, const LoadStage& stage) {
  const std::size_t axis = static_cast<std::size_t>(stage.axis);
  const AxisLoad driven = stage.is_isotropic() ? AxisLoad{AxisLoad::stress, stage.to}
                                               : stage.axes[std::min(axis, stage.axes.size() - 1)];
  const std::optional<double> before = from[axis];
  const bool compresses = stage.is_isotropic() || stage.control == "oedometric";
  if (compresses && driven.kind == AxisLoad::strain) return driven.end >= 0.0 ? "load" : "unload";
  if (!compresses || !before) return stage.control;
  return driven.end > *before ? "load" : driven.end < *before ? "unload" : "hold";
}

/// Checks the strains of a stage that imposes one on every axis: their sum is the strain of the volume.
void check_volume(TableReader& t, const LoadStage& stage) {
  double sum = 0.0;
  for (const AxisLoad& axis : stage.axes) {
    if (axis.kind != AxisLoad::strain) return;
    sum += axis.end;
  }
  if (sum > kLargestStrain)
    t.fault("axes",
            fmt::format("{}: the strains add up to {}, expected at most {} (beyond, the cell would close)",
                        t.path_of("axes"), sum, kLargestStrain));
}

/// Checks that no axis keeps a stress of zero without adhesion, if it is known from the stage before.
void check_kept_stress(TableReader& t, const KnownStress& from, const LoadStage& stage, const Law& law) {
  if (law.adheres()) return;
  for (std::size_t a = 0; a < std::min(from.size(), stage.axes.size()); ++a)
    if (stage.axes[a].kind == AxisLoad::kept_stress && from[a] == 0.0)
      return t.fault("control",
                     fmt::format("{} = \"{}\": axis {} would keep a stress of 0; expected a positive "
                                 "pressure before; nothing holds grains without adhesion together",
                                 t.path_of("control"), stage.control, a + 1));
}

/// Checks stages that end at zero stress.
/// @param cell_cap  whether the scene caps rates by the inertial number, which allows no motion at zero pressure
void check_zero_stress(TableReader& t, const LoadStage& stage, bool has_end, const Law& law, bool cell_cap) {
  const bool zero = stage.is_isotropic()
                        ? has_end && stage.to == 0.0
                        : std::any_of(stage.axes.begin(), stage.axes.end(), [](const AxisLoad& a) {
                            return a.kind == AxisLoad::stress && a.end == 0.0;
                          });
  if (!zero) return;
  const char* key = t.has("axes") ? "axes" : "to";
  if (stage.is_isotropic() && stage.cell.inertial_number_cap)
    t.fault("inertial_number_cap",
            fmt::format("{}: at P = 0 it lets nothing move; expected cell.strain_rate_cap",
                        t.path_of("inertial_number_cap")));
  if (!t.has(key)) return;
  if (!law.adheres())
    t.fault(key,
            fmt::format("{} = 0: expected a positive pressure; nothing holds grains without adhesion together",
                        t.path_of(key)));
  else if (stage.is_isotropic() && cell_cap && !stage.cell.has_cap())
    t.fault(key, fmt::format("{} = 0: cell.inertial_number_cap lets nothing move there; expected "
                             "cell.strain_rate_cap in its place",
                             t.path_of(key)));
}

/// Checks the loads on axes of a box: a stress is imposed by walls that move, and all other axes keep their length.
void check_walls(TableReader& t, const BoxOptions& box, const LoadStage& stage) {
  const char* key = t.has("axes") ? "axes" : "control";
  for (std::size_t a = 0; a < stage.axes.size(); ++a) {
    if (stage.axes[a].kind == AxisLoad::strain)
      return t.fault(
          key, fmt::format("{}: gives axis {} a length, but walls are under a stress or at rest; expected "
                           "stresses, and box.boundary = \"fixed\" for axes that keep their length",
                           t.path_of(key), a + 1));
    if (stage.axes[a].kind == AxisLoad::stress && box.boundary[a] != BoxSide::walls)
      return t.fault(key, fmt::format("{}: no wall along axis {} can carry its stress; expected an axis whose "
                                      "box.boundary is \"walls\"",
                                      t.path_of(key), a + 1));
  }
}

/// Reads one stage of the load path.
/// @param scene  scene without its stages
/// @param from   stresses before the stage
LoadStage read_stage(TableReader t, const Scene& scene, const KnownStress& from, Law& law) {
  const std::optional<BoxOptions>& box = scene.assembly.box;
  LoadStage stage;
  const int dimension = static_cast<int>(from.size());
  stage.axis = dimension - 1;
  stage.control = kControls[t.choice("control", kControls, Need::optional).value_or(0)];
  bool has_end = true;
  if (stage.control == "isotropic") {
    const auto to = t.number("to", {not_negative, "a pressure >= 0 (compression positive)"});
    has_end = to.has_value();
    stage.to = to.value_or(from.front().value_or(0.0));
    for (const char* key : {"axis", "axes", "strain", "strain_step"})
      t.refuse(key,
               fmt::format(
                   "{} is not allowed here: the load is isotropic; leave the key out or choose another control",
                   t.path_of(key)));
  } else {
    read_axes_of(t, dimension, stage);
    // An equal stress on every axis is treated as the isotropic load, so that both give identical results.
    if (stage.control == "axes" && !stage.axes.empty() && stage.axes[0].kind == AxisLoad::stress &&
        std::count(stage.axes.begin(), stage.axes.end(), stage.axes[0]) == dimension) {
      stage.to = stage.axes[0].end;
      stage.axes.clear();
    } else if (static_cast<int>(stage.axes.size()) != dimension) {
      stage.axes.assign(from.size(), AxisLoad{});  // a fault has been recorded
    }
  }
  stage.steps_per_decade =
      t.number("steps_per_decade",
               {is_steps_per_decade, "a number of steps per decade of pressure, in (0, 1000]"}, Need::optional);
  if (const auto steps =
          t.integer("steps", {1, kMaxSteps, "a whole number of steps, 1 to 10000"}, Need::optional))
    stage.steps = static_cast<int>(*steps);
  if (stage.is_isotropic())
    check_isotropic_steps(t, from, has_end, stage);
  else
    read_step_size(t, from, stage);
  stage.name = t.text("name", "a string", Need::optional).value_or(default_name(from, stage));
  stage.set = t.flat_numbers("set");
  stage.cell = read_cell_response(t, box.has_value());
  if (box) check_walls(t, *box, stage);
  apply_changes(t, stage, law);
  if (stage.cell.strain_rate_cap && !law.adheres())
    t.fault("strain_rate_cap", fmt::format("{}: is in units of 1/T0, T0 = sqrt(a m/F0), but the grains do not "
                                           "adhere; expected inertial_number_cap",
                                           t.path_of("strain_rate_cap")));
  check_zero_stress(t, stage, has_end, law, scene.relaxation.inertial_number_cap.has_value());
  check_kept_stress(t, from, stage, law);
  check_volume(t, stage);
  t.refuse_other_keys();
  return stage;
}

}  // namespace

CellResponse read_cell_response(TableReader& t, bool boxed) {
  if (boxed) {
    for (const char* key : {"inertial_number_cap", "strain_rate_cap", "cell_mass"})
      t.refuse(key, fmt::format("{} is not allowed here: a [box] has walls and no cell", t.path_of(key)));
    CellResponse response;
    response.wall_speed = t.number("speed",
                                   {positive,
                                    "a positive number (speed at which walls approach each other, or move "
                                    "apart, until they bear their pressure)"},
                                   Need::optional);
    return response;
  }
  t.refuse("speed", fmt::format("{} is not allowed here: the scene has no [box] whose walls could move at it",
                                t.path_of("speed")));
  CellResponse response = read_rate_caps(t);
  response.cell_mass = t.number("cell_mass", kCellMass, Need::optional);
  return response;
}

CellResponse read_rate_caps(TableReader& t) {
  CellResponse response;
  response.strain_rate_cap = t.number("strain_rate_cap", kStrainRateCapRule, Need::optional);
  response.inertial_number_cap = t.number("inertial_number_cap", kInertialNumberCap, Need::optional);
  if (t.has("strain_rate_cap") && t.has("inertial_number_cap"))
    t.fault("inertial_number_cap", fmt::format("{}: expected either this or strain_rate_cap, not both",
                                               t.path_of("inertial_number_cap")));
  return response;
}

void read_load(TableReader& root, const CellResponse& unsaid, Scene& scene) {
  Law law = scene.law;
  KnownStress from(static_cast<std::size_t>(scene.dimension), scene.assembly.pressure);
  for (TableReader& t : root.tables("load", "tables [[load]]")) {
    scene.load.push_back(read_stage(t, scene, from, law));
    scene.load.back().cell = scene.load.back().cell.or_else(unsaid);
    from = after_stage(from, scene.load.back());
  }
}

}  // namespace floc
