#include "floc/scene/read_dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "floc/contact/law_parameters.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// Whether the normal law of the scene was read without faults. Otherwise the contact law of the scene is a
/// placeholder.
bool knows_normal_law(TableReader& root, const SceneSource& source) {
  return root.table("contact", "", Need::optional).has("normal") && !source.is_faulty("contact.normal") &&
         !source.is_faulty("contact.normal.law");
}

/// Whether it is known which grains have shapes: the table grains.shape and the saved start were read without faults.
bool knows_shapes(TableReader& root, const SceneSource& source, const Scene& scene) {
  const bool names_shape = root.table("grains", "", Need::optional).has("shape");
  return !source.is_faulty("assembly.state") && (!names_shape || scene.grains.shape);
}

/// Reads the settings of contact dynamics that rigid and elastic grains share.
void read_steps(TableReader& t, ContactDynamicsOptions& options) {
  options.time_step =
      t.number("time_step",
               {[](double x) { return x > 0 && x <= 1; },
                "a number in (0, 1] (longest time step in units of T = sqrt(m/(P a^(d-2))), with "
                "the mass m and the diameter a of the largest grain, the pressure P and the "
                "dimension d)"},
               Need::optional)
          .value_or(options.time_step);
  options.sweep_tolerance =
      t.number(
           "sweep_tolerance",
           {[](double x) { return x > 0 && x <= 0.1; },
            "a number in (0, 0.1] (error of the impulses of a time step divided by the mean normal impulse)"},
           Need::optional)
          .value_or(options.sweep_tolerance);
  options.max_sweeps = static_cast<int>(
      t.integer("max_sweeps",
                {1, 1'000'000, "the largest number of sweeps in a time step, a whole number from 1 to 1000000"},
                Need::optional)
          .value_or(options.max_sweeps));
}

/// Reads the settings of contact dynamics that only rigid contacts have.
void read_rigid_settings(TableReader& t, ContactDynamicsOptions& options) {
  options.restitution = t.number("restitution",
                                 {[](double x) { return x >= 0 && x <= 1; },
                                  "a number from 0 to 1 (coefficient of restitution of normal impacts)"},
                                 Need::optional)
                            .value_or(options.restitution);
  if (const auto finish =
          t.choice("finish", {kRigidForcesKeywords.begin(), kRigidForcesKeywords.end()}, Need::optional))
    options.forces = static_cast<RigidForces>(*finish);
  options.gap_tolerance = t.number("gap_tolerance",
                                   {[](double x) { return x > 0 && x <= 0.1; },
                                    "a number in (0, 0.1] (largest gap or overlap of a contact that carries a "
                                    "force, divided by the diameter of its smaller grain)"},
                                   Need::optional);
}

/// Key that is not allowed with one of the two methods of motion (smooth dynamics or contact dynamics), and the end of
/// the message about this key.
struct KeyInPlace {
  const char* key;
  const char* expectation;
};

/// Records a fault for each setting of contact dynamics that elastic contacts do not have.
void refuse_rigid_settings(TableReader& t) {
  constexpr KeyInPlace kRefusedKeys[] = {
      {"finish",
       "the overlaps of elastic grains determine the contact forces, so that there is no choice of forces"},
      {"restitution", "the springs of elastic contacts determine the course of impacts"},
      {"gap_tolerance", "elastic grains carry a force where they overlap"}};
  for (const auto& [key, reason] : kRefusedKeys)
    t.refuse(
        key,
        fmt::format("{} is not allowed here: it is a setting of rigid contacts, but the contacts are elastic: "
                    "{}; remove the key",
                    t.path_of(key), reason));
}

/// Records a fault for each setting of contact dynamics in a scene of elastic disks or spheres.
void refuse_contact_dynamics(TableReader& t) {
  constexpr const char* kNone = "no key";
  constexpr KeyInPlace kRefusedKeys[] = {{"time_step", "run.time_step"},
                                         {"finish", "equilibrium.finish"},
                                         {"restitution", "contact.damping"},
                                         {"sweep_tolerance", kNone},
                                         {"max_sweeps", kNone},
                                         {"gap_tolerance", kNone}};
  for (const auto& [key, expectation] : kRefusedKeys)
    t.refuse(key, fmt::format(
                      "{} is not allowed here: it is a setting of contact dynamics, which moves rigid grains, "
                      "but the contacts are elastic; expected {}{}",
                      t.path_of(key), expectation,
                      expectation == kNone ? fmt::format(" {}", key) : std::string(" in its place")));
}

/// Records a fault for each key of smooth dynamics, the motion of elastic disks and spheres, in a scene that contact
/// dynamics moves.
/// @param rigid  whether the contacts are rigid
void refuse_smooth_dynamics(TableReader& root, bool rigid) {
  constexpr KeyInPlace kRefusedInRun[] = {
      {"time_step", "the time step of contact dynamics is given by dynamics.time_step"},
      {"skin", "the skin of the neighbour lists is chosen from dynamics.time_step; remove the key"}};
  const KeyInPlace kRefusedInEquilibrium[] = {
      {"finish",
       rigid
           ? "dynamics.finish chooses among the possible forces of rigid grains at rest; give this key instead"
           : "contact dynamics ends in Newton steps; remove the key"},
      {"patience", "contact dynamics has its own criteria for the end of motion; remove the key"},
      {"masses", "the time step of contact dynamics does not depend on the masses; remove the key"}};
  TableReader run = root.table("run", "", Need::optional);
  TableReader equilibrium = root.table("equilibrium", "", Need::optional);
  const auto refuse = [&](TableReader& t, const KeyInPlace& k) {
    t.refuse(k.key, fmt::format("{} is not allowed with {}: {}", t.path_of(k.key),
                                rigid ? "rigid contacts" : "shapes of grains", k.expectation));
  };
  for (const KeyInPlace& k : kRefusedInRun) refuse(run, k);
  for (const KeyInPlace& k : kRefusedInEquilibrium) refuse(equilibrium, k);
}

/// Records a fault for each stage of the load path that imposes the lengths of all axes. Without an imposed stress, the
/// magnitude of the forces between rigid grains is undetermined. The springs of elastic grains with shapes determine
/// their forces, but contact dynamics takes its unit of time and the scale of its tolerances from an imposed stress
/// (ContactDynamicsRelaxer).
void check_stages(TableReader& root, const Scene& scene) {
  if (scene.load.empty()) return;
  std::vector<TableReader> stages = root.tables("load", "tables [[load]]");
  for (std::size_t k = 0; k < std::min(stages.size(), scene.load.size()); ++k) {
    TableReader& t = stages[k];
    const LoadStage& stage = scene.load[k];
    const bool all_strained =
        !stage.is_isotropic() &&
        std::ranges::all_of(stage.axes, [](const AxisLoad& axis) { return axis.kind == AxisLoad::strain; });
    if (all_strained)
      t.fault(
          "control",
          fmt::format(
              "{} = \"{}\": this stage imposes the lengths of all axes, but {}; expected a stage that keeps or "
              "imposes a stress",
              t.path_of("control"), stage.control,
              scene.law.is_rigid()
                  ? "rigid grains need a stress on at least one axis, because otherwise their "
                    "forces have no scale"
                  : "elastic grains with shapes need a stress on at least one axis in this "
                    "version of floc, because their time step and their tolerances are relative to it"));
  }
}

/// Records a fault for each method of assembly that is not possible with rigid contacts.
void check_assembly(TableReader& root, const Scene& scene) {
  TableReader t = root.table("assembly", "", Need::optional);
  if (scene.assembly.protocol == AssemblyOptions::Protocol::aggregation)
    t.fault(
        "protocol",
        "assembly.protocol = \"aggregation\": rigid grains are not aggregated in this version of floc, because "
        "they do not attract each other across gaps; expected protocol = \"direct\" or \"state\"");
  t.refuse(
      "vibration",
      "assembly.vibration is not allowed with rigid contacts: only packings of elastic grains can be vibrated "
      "in this version of floc; remove the key");
}

/// Checks a scene of elastic grains with shapes. Records a fault for each of its parts that is possible only with
/// disks, spheres or rigid grains.
void check_elastic_shapes(TableReader& root, const Scene& scene) {
  constexpr const char* kRefused =
      "{} is not allowed with elastic contacts of grains with shapes in this version of floc: {}; expected {}";
  TableReader contact = root.table("contact", "", Need::optional);
  const auto refuse = [&](const char* key, bool present, const char* reason, const char* expectation) {
    if (present) contact.fault(key, fmt::format(kRefused, contact.path_of(key), reason, expectation));
  };
  const LawParameters& law = scene.law.parameters();
  refuse("normal", !law.normal.holds<LinearRepulsion>(), "each contact point is a linear spring",
         "contact.normal = {law = \"linear\", stiffness}, or {law = \"rigid\"}");
  refuse("friction", law.friction && !law.friction.holds<CoulombFriction>(),
         "each contact point is a linear spring", "contact.friction = {coefficient, stiffness}");
  refuse("adhesion", static_cast<bool>(law.adhesion), "the contacts of these grains only repel",
         "no key adhesion");
  refuse("damping", static_cast<bool>(law.damping), "implicit time steps dissipate energy by themselves",
         "no key damping");
  refuse("rolling", static_cast<bool>(law.rolling), "their corners resist rolling", "no key rolling");
  refuse("twisting", static_cast<bool>(law.twisting), "their corners resist twisting", "no key twisting");
  if (scene.assembly.box && scene.assembly.box->adhesion > 0.0)
    root.table("box", "").fault(
        "adhesion",
        fmt::format(kRefused, "box.adhesion", "the contacts of these grains only repel", "box.adhesion = 0"));
  TableReader assembly = root.table("assembly", "", Need::optional);
  assembly.refuse("vibration", fmt::format(kRefused, "assembly.vibration",
                                           "only disks and spheres are vibrated", "no key vibration"));
  check_stages(root, scene);
}

}  // namespace

void read_dynamics(TableReader& root, const SceneSource& source, Scene& scene) {
  TableReader t = root.table("dynamics", "a table [dynamics]", Need::optional);
  const bool knows_law = knows_normal_law(root, source);
  const bool knows_method = knows_law && knows_shapes(root, source, scene);
  const auto method = t.choice("method", {"smooth", "contact_dynamics"}, Need::optional);
  // If the normal law is missing or has a fault, the law of the scene is a placeholder. The method is then taken from
  // the key, and the key is not compared with the law, because such a comparison could report a fault that does not
  // exist. The same is done if the shapes of the grains are not known.
  const bool implicit = knows_method ? scene.has_contact_dynamics() : method != std::optional<std::size_t>(0);
  if (knows_method && method && implicit && *method == 0)
    t.fault(
        "method",
        fmt::format(
            "dynamics.method = \"smooth\": {}, so only contact dynamics can move the grains; expected method "
            "= \"contact_dynamics\", or no key method",
            scene.law.is_rigid()
                ? "rigid contacts have no stiffness"
                : "the contact forces of grains with shapes jump when other corners come into contact"));
  if (knows_method && method && !implicit && *method == 1)
    t.fault("method",
            fmt::format(
                "dynamics.method = \"contact_dynamics\": contact dynamics moves only rigid grains and grains "
                "with shapes, but contact.normal.law is \"{}\"; expected contact.normal = {{law = \"rigid\"}}, "
                "or method = \"smooth\"",
                scene.law.normal_keyword()));
  // If the scene asks for contact dynamics where only smooth dynamics is possible, the fault has been recorded above.
  // The length of time steps and the limits of sweeps are then read as for contact dynamics, so that they cause no
  // further faults.
  const bool steps = implicit || (method && *method == 1);
  if (steps)
    read_steps(t, scene.relaxation.contact_dynamics);
  else
    refuse_contact_dynamics(t);
  // The settings of rigid contacts, such as the restitution, do not exist for elastic contacts. If the law is not
  // known, the contacts may be rigid, and these settings are accepted.
  if (steps && knows_law && !scene.law.is_rigid())
    refuse_rigid_settings(t);
  else if (steps)
    read_rigid_settings(t, scene.relaxation.contact_dynamics);
  t.refuse_other_keys();
}

void check_rigid(TableReader& root, const SceneSource& source, const Scene& scene) {
  if (!knows_normal_law(root, source)) return;
  const bool rigid = scene.law.is_rigid();
  if (!scene.has_contact_dynamics()) return;
  root.refuse(
      "accuracy",
      fmt::format(
          "[accuracy] is not allowed with {}: the errors in the table shipped with floc were measured "
          "on elastic {}; remove [accuracy] and give the numerical settings ([equilibrium], [dynamics])",
          rigid ? "rigid contacts" : "shapes of grains", rigid ? "grains" : "disks and spheres"));
  if (rigid) {
    check_assembly(root, scene);
    check_stages(root, scene);
  } else {
    check_elastic_shapes(root, scene);
  }
  refuse_smooth_dynamics(root, rigid);
}

}  // namespace floc
