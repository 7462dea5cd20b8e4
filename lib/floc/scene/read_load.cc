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
/// Largest logarithmic strain of an axis in one stage. At a strain of 2 the length of the axis is 0.14 of its original
/// length; at larger strains the cell would practically vanish.
constexpr double kLargestStrain = 2.0;
constexpr bool is_strain(double x) {
  return x >= -kLargestStrain && x <= kLargestStrain;
}
constexpr std::int64_t kMaxSteps = 10'000;
constexpr double kRoundingPerStep = 1e-6;

constexpr NumberRule kStrain{
    is_strain,
    "a logarithmic strain from -2 to 2 (compression positive; at larger strains the cell would nearly vanish)"};
/// Largest shear strain of one stage. This strain is large enough for every test, because a packing reaches its steady
/// state much earlier.
constexpr NumberRule kShear{[](double x) { return x >= -100 && x <= 100; }, "a shear strain from -100 to 100"};
const std::vector<std::string> kControls = {"isotropic",       "oedometric", "triaxial",
                                            "constant_volume", "axes",       "simple_shear"};

std::vector<std::string> law_keys(LawParameters law) {
  std::vector<std::string> keys;
  for (const LawNumber& n : numbers_of(law)) keys.push_back(n.key);
  return keys;
}

/// Applies the changes of the contact law in a stage (key "set" of the stage), and records faults in these changes.
/// @param present  contact law before the stage, replaced by the law during the stage
void apply_changes(TableReader& t, const LoadStage& stage, Law& present) {
  LawParameters law = present;
  for (const auto& [key, value] : stage.set) {
    double* number = law_number(law, key);
    if (!number) {
      t.fault("set", fmt::format("{}.set.{}: the contact law of the scene has no such parameter; its parameter "
                                 "with the most similar name is {}",
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

/// Reads the load on one axis at the end of a stage: a stress, or a logarithmic strain (key "strain").
/// @param stress_key  key that gives the stress
/// @param of_stress  description of the accepted stresses, for messages
AxisLoad read_axis_load(TableReader& t, const char* stress_key, const char* of_stress) {
  const bool has_stress = t.has(stress_key);
  const auto stress = t.number(stress_key, {not_negative, of_stress}, Need::optional);
  const auto strain = t.number("strain", kStrain, Need::optional);
  if (has_stress && t.has("strain"))
    t.fault("strain", fmt::format("{} is given together with {}: expected only one of them",
                                  t.path_of("strain"), stress_key));
  else if (t && !has_stress && !t.has("strain"))
    t.fault(stress_key,
            fmt::format("{} is missing: expected either {} or strain", t.path_of(stress_key), stress_key));
  if (strain) return {AxisLoad::strain, *strain};
  return {AxisLoad::stress, stress.value_or(0.0)};
}

/// Reads the key "axes" of a stage, which gives the load on each axis, for example `axes = [{stress = 2.0}, {strain =
/// 0.1}, {as = 1}]`. Here {as = 1} means the load of axis 1.
std::vector<AxisLoad> read_axes(TableReader& t, int dimension) {
  std::vector<AxisLoad> axes;
  const char* expectation =
      "an array with one table for each axis: {stress = ..}, {strain = ..} or {as = 1} (the load of axis 1)";
  std::vector<TableReader> tables = t.tables("axes", expectation);
  if (t && (!t.has("axes") || static_cast<int>(tables.size()) != dimension))
    t.fault("axes", fmt::format("{} has {} tables: expected {}, one for each axis: {{stress = ..}}, {{strain = "
                                "..}} or {{as = 1}} (the load of axis 1)",
                                t.path_of("axes"), tables.size(), dimension));
  for (TableReader& axis : tables) {
    const auto as =
        axis.integer("as", {1, 3, "the number of an earlier axis, whose load this axis takes"}, Need::optional);
    const bool known = as && *as <= static_cast<std::int64_t>(axes.size());
    if (as && !known)
      axis.fault("as",
                 fmt::format("{} = {}: expected the number of an earlier axis, whose load this axis takes",
                             axis.path_of("as"), *as));
    if (as)
      axes.push_back(known ? axes[static_cast<std::size_t>(*as - 1)] : AxisLoad{});
    else
      axes.push_back(read_axis_load(axis, "stress", "a stress >= 0 (compression positive)"));
    axis.refuse_other_keys();
  }
  return axes;
}

/// Returns the loads that a test imposes on all axes. The test drives one axis to a stress or to a strain.
/// @param control  keyword of the test, which determines the loads on the other axes: "oedometric" (their lengths stay
/// constant), "triaxial" (their stresses stay constant) or "constant_volume" (the volume of the cell stays constant)
/// @param axis  axis that is driven, counted from 0
std::vector<AxisLoad> read_test(TableReader& t, const std::string& control, int axis, int dimension) {
  if (control == "constant_volume" && t.has("to"))
    t.fault("to", fmt::format("{} is not allowed here: a stage at constant volume imposes a length, not a "
                              "stress, on the driven axis; expected the key strain",
                              t.path_of("to")));
  const AxisLoad driven = read_axis_load(t, "to", "a stress >= 0 (compression positive)");
  AxisLoad other{AxisLoad::kept_stress, 0.0};
  if (control == "oedometric") other = {AxisLoad::strain, 0.0};
  if (control == "constant_volume") other = {AxisLoad::strain, -driven.end / (dimension - 1)};
  std::vector<AxisLoad> axes(static_cast<std::size_t>(dimension), other);
  axes[static_cast<std::size_t>(axis)] = driven;
  return axes;
}

/// Reads a stage of simple shear. The planes perpendicular to the axis `stage.axis` move along the first axis. The
/// stress on `stage.axis` and the lengths of all other axes stay constant.
void read_shear(TableReader& t, int dimension, LoadStage& stage) {
  const char* which = dimension == 2
                          ? "the number of the axis perpendicular to the planes that are sheared, 2"
                          : "the number of the axis perpendicular to the planes that are sheared, 2 or 3";
  if (const auto axis = t.integer("axis", {2, dimension, which}, Need::optional))
    stage.axis = static_cast<int>(*axis) - 1;
  t.refuse("to", fmt::format("{} is not allowed here: a simple shear imposes a strain and keeps the stress; "
                             "expected the key strain",
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
      t.refuse(key, fmt::format(
                        "{} is not allowed with control = \"axes\": the key axes gives the load on each axis",
                        t.path_of(key)));
    return;
  }
  t.refuse("axes",
           fmt::format("{} is used only with control = \"axes\": expected this control, or remove the key",
                       t.path_of("axes")));
  if (stage.control == "simple_shear") return read_shear(t, dimension, stage);
  const char* which =
      dimension == 2 ? "the number of the driven axis, 1 or 2" : "the number of the driven axis, 1 to 3";
  if (const auto axis = t.integer("axis", {1, dimension, which}, Need::optional))
    stage.axis = static_cast<int>(*axis) - 1;
  stage.axes = read_test(t, stage.control, stage.axis, dimension);
}

/// Whether the key steps_per_decade determines the number of steps of a stage. The key determines the number if three
/// conditions are met: the stage imposes a stress; all imposed stresses are positive at the start and at the end of the
/// stage; and the stresses at the start are known before the run.
/// @param from  stress on each axis at the start of the stage, as far as it is known before the run
bool counts_in_decades(const KnownStress& from, const LoadStage& stage) {
  bool any = false;
  for (std::size_t a = 0; a < std::min(from.size(), stage.axes.size()); ++a) {
    if (stage.axes[a].kind != AxisLoad::stress) continue;
    if (!(from[a].value_or(0.0) > 0.0 && stage.axes[a].end > 0.0)) return false;
    any = true;
  }
  return any;
}

/// Reads the number of steps of a stage that imposes different loads on its axes.
/// @param from  stress on each axis at the start of the stage, as far as it is known before the run
void read_step_size(TableReader& t, const KnownStress& from, LoadStage& stage) {
  const auto strain_step =
      t.number("strain_step", {positive, "a positive number (strain of one step)"}, Need::optional);
  const double strain = stage.largest_strain();
  const int given = (stage.steps ? 1 : 0) + (stage.steps_per_decade ? 1 : 0) + (strain_step ? 1 : 0);
  if (given > 1)
    t.fault("steps", fmt::format("{}: the number of steps is given more than once; expected only one of steps, "
                                 "strain_step and steps_per_decade",
                                 t.path_of(strain_step ? "strain_step" : "steps")));
  if (strain_step && strain == 0.0)
    t.fault(
        "strain_step",
        fmt::format("{} is not allowed here: the stage imposes no strain; expected steps or steps_per_decade",
                    t.path_of("strain_step")));
  if (strain_step && strain > 0.0) {
    // If the strain is a multiple of strain_step, rounding could add a step. The tolerance kRoundingPerStep prevents
    // this.
    const double n = std::ceil(strain / *strain_step - kRoundingPerStep);
    if (n > static_cast<double>(kMaxSteps))
      t.fault("strain_step",
              fmt::format("{} = {}: this makes {} steps to the strain {}, expected at most {} steps",
                          t.path_of("strain_step"), *strain_step, n, strain, kMaxSteps));
    else
      stage.steps = std::max(1, static_cast<int>(n));
  }
  // steps_per_decade gives the number of steps from the ratio of the stresses at the end and at the start of the stage.
  // Both stresses must therefore be positive and known.
  if (stage.steps_per_decade && !counts_in_decades(from, stage))
    t.fault("steps_per_decade",
            fmt::format("{} is not allowed here: the stress at the start of the stage is zero or not known "
                        "before the run; expected steps{}",
                        t.path_of("steps_per_decade"), strain > 0.0 ? " or strain_step" : ""));
  if (given == 0 && t)
    t.fault("steps", fmt::format("{} is missing: expected steps{}", t.path_of("steps"),
                                 strain > 0.0 ? " or strain_step" : " or steps_per_decade"));
}

/// Checks the keys that give the number of steps of a stage that ends at equal pressures on all axes.
/// @param from  stress on each axis at the start of the stage, as far as it is known before the run
/// @param has_end  whether the stage has a valid pressure "to"
void check_isotropic_steps(TableReader& t, const KnownStress& from, bool has_end, const LoadStage& stage) {
  const bool by_decade = t.has("steps_per_decade");
  const bool by_number = t.has("steps");
  if (by_decade && by_number)
    t.fault("steps", fmt::format("{} is given together with steps_per_decade: expected only one of them",
                                 t.path_of("steps")));
  const bool is_one_step =
      is_isotropic(from) && (stage.to == from.front() || stage.to == 0 || from.front() == 0.0);
  if (has_end && !by_decade && !by_number && !is_one_step)
    t.fault("steps",
            fmt::format("{} is missing: expected steps_per_decade or steps", t.path_of("steps_per_decade")));
  if (by_decade && std::any_of(from.begin(), from.end(), [](const auto& s) { return !s.has_value(); }))
    t.fault("steps_per_decade", fmt::format("{} is not allowed here: the stresses at the start of the stage "
                                            "are not known before the run; expected steps",
                                            t.path_of("steps_per_decade")));
}

/// Returns the mean of the stresses on all axes; absent if one of them is not known. Equal stresses are their own mean,
/// to all digits.
std::optional<double> mean_stress(const KnownStress& from) {
  double sum = 0.0;
  bool are_equal = true;
  for (const std::optional<double>& stress : from) {
    if (!stress) return std::nullopt;
    sum += *stress;
    are_equal = are_equal && *stress == *from.front();
  }
  return are_equal ? *from.front() : sum / static_cast<double>(from.size());
}

/// Returns the default name of a stage, which is used if the scene gives no name. For an isotropic or oedometric stage,
/// the name is "load", "unload" or "hold", provided it is known before the run whether the load increases. In all other
/// cases the name is the value of the key "control", for example "triaxial".
/// @param from  stress on each axis at the start of the stage, as far as it is known before the run
std::string default_name(const KnownStress& from, const LoadStage& stage) {
  const std::size_t axis = static_cast<std::size_t>(stage.axis);
  const AxisLoad driven = stage.is_isotropic() ? AxisLoad{AxisLoad::stress, stage.to}
                                               : stage.axes[std::min(axis, stage.axes.size() - 1)];
  const std::optional<double> before = stage.is_isotropic() ? mean_stress(from) : from[axis];
  const bool compresses = stage.is_isotropic() || stage.control == "oedometric";
  if (compresses && driven.kind == AxisLoad::strain) return driven.end >= 0.0 ? "load" : "unload";
  if (!compresses || !before) return stage.control;
  return driven.end > *before ? "load" : driven.end < *before ? "unload" : "hold";
}

/// Checks the change of volume in a stage that imposes a strain on every axis: the sum of the logarithmic strains must
/// not be so large that the cell nearly vanishes.
void check_volume(TableReader& t, const LoadStage& stage) {
  double sum = 0.0;
  for (const AxisLoad& axis : stage.axes) {
    if (axis.kind != AxisLoad::strain) return;
    sum += axis.end;
  }
  if (sum > kLargestStrain)
    t.fault("axes", fmt::format("{}: the strains of all axes add up to {}, expected at most {} (at larger "
                                "strains the cell would nearly vanish)",
                                t.path_of("axes"), sum, kLargestStrain));
}

/// Checks that no axis keeps a stress of zero during a stage, unless the grains adhere. Without adhesion, nothing would
/// hold the grains together. Stresses that are not known before the run are not checked.
/// @param from  stress on each axis at the start of the stage, as far as it is known before the run
void check_kept_stress(TableReader& t, const KnownStress& from, const LoadStage& stage, const Law& law) {
  if (law.adheres()) return;
  for (std::size_t a = 0; a < std::min(from.size(), stage.axes.size()); ++a)
    if (stage.axes[a].kind == AxisLoad::kept_stress && from[a] == 0.0)
      return t.fault(
          "control",
          fmt::format("{} = \"{}\": axis {} would keep a stress of 0, at which grains without adhesion do not "
                      "hold together; expected a positive pressure before this stage",
                      t.path_of("control"), stage.control, a + 1));
}

/// Checks a stage that ends at zero stress on an axis. The grains must adhere and must not be rigid, and the caps on
/// the strain rate must allow a motion of the cell at zero pressure.
/// @param has_end  whether the stage has a valid pressure "to"
/// @param cell_cap  whether the table [cell] caps the inertial number; such a cap allows no motion at zero pressure
void check_zero_stress(TableReader& t, const LoadStage& stage, bool has_end, const Law& law, bool cell_cap) {
  const bool zero = stage.is_isotropic()
                        ? has_end && stage.to == 0.0
                        : std::any_of(stage.axes.begin(), stage.axes.end(), [](const AxisLoad& a) {
                            return a.kind == AxisLoad::stress && a.end == 0.0;
                          });
  if (!zero) return;
  const char* key = t.has("axes") ? "axes" : "to";
  if (law.is_rigid()) {
    if (t.has(key))
      t.fault(key, fmt::format("{} = 0: rigid grains need a positive pressure, because at zero pressure their "
                               "forces are not determined; expected a positive pressure",
                               t.path_of(key)));
    return;
  }
  // A cap on the inertial number I = |L'/L| sqrt(m/P) allows strain rates up to I sqrt(P/m). At zero pressure P, this
  // limit is zero, and the cell could not move.
  if (stage.is_isotropic() && stage.cell.inertial_number_cap)
    t.fault("inertial_number_cap", fmt::format("{}: at zero pressure a cap on the inertial number allows no "
                                               "motion; expected cell.strain_rate_cap in its place",
                                               t.path_of("inertial_number_cap")));
  // If the key is missing, the stress of zero is only a placeholder, and the missing key has been reported already.
  if (!t.has(key)) return;
  if (!law.adheres())
    t.fault(key, fmt::format("{} = 0: without adhesion nothing holds the grains together at zero pressure; "
                             "expected a positive pressure",
                             t.path_of(key)));
  // The cap of the table [cell] acts on a stage only if the stage has no cap of its own.
  else if (stage.is_isotropic() && cell_cap && !stage.cell.has_cap())
    t.fault(key, fmt::format("{} = 0: at zero pressure cell.inertial_number_cap allows no motion; expected "
                             "cell.strain_rate_cap in its place",
                             t.path_of(key)));
}

/// Checks the loads that a stage imposes on the axes of a box with walls. A stress can be imposed only on an axis with
/// walls that can move; the lengths of all other axes must stay constant.
void check_walls(TableReader& t, const BoxOptions& box, const LoadStage& stage) {
  const char* key = t.has("axes") ? "axes" : "control";
  for (std::size_t a = 0; a < stage.axes.size(); ++a) {
    if (stage.axes[a].kind == AxisLoad::strain)
      return t.fault(
          key, fmt::format(
                   "{}: the stage imposes a length on axis {}, but walls either move under a stress or stay at "
                   "rest; expected a stress, or box.boundary = \"fixed\" for an axis that keeps its length",
                   t.path_of(key), a + 1));
    if (stage.axes[a].kind == AxisLoad::stress && !moves(box.boundary[a]))
      return t.fault(key, fmt::format("{}: axis {} has no walls that could move under the imposed stress; "
                                      "expected an axis whose box.boundary is \"walls\"",
                                      t.path_of(key), a + 1));
  }
}

/// Reads the key that gives the strain rate of a stage with rigid grains.
void read_strain_rate(TableReader& t, const Law& law, LoadStage& stage) {
  constexpr const char* kKey = "inertial_number";
  if (!law.is_rigid())
    return t.refuse(
        kKey, fmt::format("{} is not allowed here: it is the rate at which rigid grains are strained, but the "
                          "contacts are elastic; expected inertial_number_cap in its place",
                          t.path_of(kKey)));
  stage.cell.inertial_number = t.number(
      kKey,
      {[](double x) { return x > 0 && x <= 0.1; },
       "a number in (0, 0.1] (strain rate of the stage times sqrt(m/(P a^(d-2))), with the mass m and the "
       "diameter a of the largest grain, the mean P of the imposed stresses and the dimension d)"},
      Need::optional);
  if (t.has(kKey) && stage.largest_strain() == 0.0)
    t.fault(kKey, fmt::format("{} is not allowed here: the stage imposes no strain", t.path_of(kKey)));
}

/// Reads one stage of the load path.
/// @param scene  scene, whose contact law, assembly and box have been read
/// @param from  stress on each axis at the start of the stage, as far as it is known before the run
/// @param law  contact law before the stage, replaced by the law during the stage
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
      t.refuse(key, fmt::format("{} is not allowed here: the load of this stage is isotropic; remove the key "
                                "or choose another control",
                                t.path_of(key)));
  } else {
    read_axes_of(t, dimension, stage);
    // If the key "axes" gives equal stresses for all axes, the stage is treated as isotropic, so that both notations
    // give identical results.
    if (stage.control == "axes" && !stage.axes.empty() && stage.axes[0].kind == AxisLoad::stress &&
        std::count(stage.axes.begin(), stage.axes.end(), stage.axes[0]) == dimension) {
      stage.to = stage.axes[0].end;
      stage.axes.clear();
    } else if (static_cast<int>(stage.axes.size()) != dimension) {
      stage.axes.assign(from.size(), AxisLoad{});  // a fault has been recorded for the key "axes"
    }
  }
  stage.steps_per_decade =
      t.number("steps_per_decade",
               {is_steps_per_decade, "the number of steps per decade of pressure, a number in (0, 1000]"},
               Need::optional);
  if (const auto steps = t.integer(
          "steps", {1, kMaxSteps, "the number of steps, a whole number from 1 to 10000"}, Need::optional))
    stage.steps = static_cast<int>(*steps);
  if (stage.is_isotropic())
    check_isotropic_steps(t, from, has_end, stage);
  else
    read_step_size(t, from, stage);
  stage.name = t.text("name", "a string", Need::optional).value_or(default_name(from, stage));
  stage.set = t.flat_numbers("set");
  stage.cell = read_cell_response(t, box.has_value());
  read_strain_rate(t, law, stage);
  if (box) check_walls(t, *box, stage);
  apply_changes(t, stage, law);
  if (stage.cell.strain_rate_cap && !law.adheres())
    t.fault("strain_rate_cap",
            fmt::format("{} is not allowed here: its unit 1/T0, with T0 = sqrt(a m/F0), requires a pull-off "
                        "force F0, but the grains do not adhere; expected inertial_number_cap",
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
    for (const char* key : {"inertial_number_cap", "strain_rate_cap", "cell_mass", "softening", "time_step"})
      t.refuse(key,
               fmt::format("{} is not allowed here: a scene with a table [box] has walls and no periodic cell",
                           t.path_of(key)));
    CellResponse response;
    response.wall_speed = t.number("speed",
                                   {positive,
                                    "a positive number (speed at which opposite walls approach each other, or "
                                    "move apart, until the grains carry the pressure)"},
                                   Need::optional);
    return response;
  }
  t.refuse("speed",
           fmt::format("{} is not allowed here: it is the speed of walls, but the scene has no table [box]",
                       t.path_of("speed")));
  CellResponse response = read_rate_caps(t);
  response.cell_mass = t.number("cell_mass", kCellMass, Need::optional);
  response.softening = t.number("softening", kSoftening, Need::optional);
  response.time_step = t.number("time_step", kTimeStepOfStage, Need::optional);
  return response;
}

CellResponse read_rate_caps(TableReader& t) {
  CellResponse response;
  response.strain_rate_cap = t.number("strain_rate_cap", kStrainRateCapRule, Need::optional);
  response.inertial_number_cap = t.number("inertial_number_cap", kInertialNumberCap, Need::optional);
  if (t.has("strain_rate_cap") && t.has("inertial_number_cap"))
    t.fault("inertial_number_cap",
            fmt::format("{} is given together with strain_rate_cap: expected only one of them",
                        t.path_of("inertial_number_cap")));
  return response;
}

void read_load(TableReader& root, const CellResponse& unsaid, Scene& scene) {
  Law law = scene.law;
  KnownStress from = first_stress(scene.assembly, scene.dimension);
  for (TableReader& t : root.tables("load", "tables [[load]]")) {
    if (scene.assembly.box && !any_wall_moves(*scene.assembly.box, scene.dimension) &&
        !scene.assembly.box->gravity.isZero(0.0))
      t.fault("control", fmt::format("{}: no wall of the box moves, so no pressure can be imposed; remove the "
                                     "tables [[load]], or give a box.boundary with \"walls\" or \"lid\"",
                                     t.path_of("control")));
    scene.load.push_back(read_stage(t, scene, from, law));
    scene.load.back().cell = scene.load.back().cell.or_else(unsaid);
    from = after_stage(from, scene.load.back());
  }
}

}  // namespace floc
