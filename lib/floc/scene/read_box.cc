#include "floc/scene/read_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "floc/assembly/gas.h"
#include "floc/scene/scene_scales.h"

namespace floc {
namespace {

using Need = TableReader::Need;

constexpr NumberRule kPositive{positive, "a positive number"};

/// Reads the key box.boundary, which gives a keyword for each axis: "walls" (both walls move under the pressure),
/// "fixed" (both walls are at rest), "periodic" (no walls), "floor" (the lower wall is at rest, the upper end is open)
/// or "lid" (the lower wall is at rest, the upper wall moves under the pressure).
void read_boundary(TableReader& t, int dimension, BoxOptions& box) {
  constexpr std::array kSides = {BoxSide::walls, BoxSide::fixed, BoxSide::periodic, BoxSide::floor,
                                 BoxSide::lid};
  static const char* const kAxisNames[] = {"x", "y", "z"};
  if (!t.has("boundary")) return;
  TableReader sides = t.table("boundary", "a table, e.g. {x = \"periodic\", y = \"walls\"}");
  for (int a = 0; a < dimension; ++a)
    if (const auto chosen =
            sides.choice(kAxisNames[a], {"walls", "fixed", "periodic", "floor", "lid"}, Need::optional))
      box.boundary[a] = kSides[*chosen];
  sides.refuse_other_keys();
}

/// Reads the key box.gravity, and checks that a wall at rest supports the grains against gravity.
void read_gravity(TableReader& t, int dimension, BoxOptions& box) {
  const bool given = t.has("gravity");
  if (given) {
    const std::vector<double> gravity =
        t.numbers("gravity",
                  {[](double g) { return std::isfinite(g); },
                   dimension == 2 ? "two numbers, the acceleration due to gravity along each axis, e.g. [0, -1]"
                                  : "three numbers, the acceleration due to gravity along each axis, e.g. "
                                    "[0, 0, -1]"});
    // An empty list means that the value is invalid and that numbers() has already recorded a fault.
    if (gravity.empty()) return;
    if (gravity.size() != static_cast<std::size_t>(dimension))
      return t.fault("gravity", fmt::format("box.gravity has {} numbers: expected {}, one for each axis",
                                            gravity.size(), dimension));
    for (int a = 0; a < dimension; ++a) box.gravity[a] = gravity[static_cast<std::size_t>(a)];
  }
  // The axes are checked even if the key is missing, because an axis with a floor needs gravity, and the default
  // gravity is zero. With "fixed", both ends of the axis are walls at rest, so gravity may act in either direction.
  for (int a = 0; a < dimension; ++a) {
    const BoxSide side = box.boundary[a];
    const bool has_floor = side == BoxSide::floor || side == BoxSide::lid;
    if (box.gravity[a] != 0.0 && (side == BoxSide::periodic || side == BoxSide::walls))
      return t.fault(
          "gravity",
          fmt::format("box.gravity: gravity acts along axis {}, whose boundary is \"{}\", so that no "
                      "wall at rest supports the grains; expected \"floor\", \"lid\" or \"fixed\"",
                      a + 1, side == BoxSide::periodic ? "periodic" : "walls"));
    if (has_floor && !(box.gravity[a] < 0.0))
      return t.fault(
          given ? "gravity" : "boundary",
          fmt::format("{}: axis {} has a floor at its lower end (boundary \"{}\"), so gravity must act "
                      "towards the floor; expected a negative number for this axis{}",
                      given ? "box.gravity" : "box.boundary", a + 1, side == BoxSide::floor ? "floor" : "lid",
                      given ? "" : " in box.gravity"));
  }
}

/// Reads the pressure on the walls that move. If no wall moves, the unit of pressure of the scene is the weight per
/// area of a layer of the largest grains: m g/a^(D-1). Here m is the mass and a the diameter of a largest grain, g the
/// acceleration due to gravity and D the dimension.
void read_pressure(TableReader& t, Scene& scene, const BoxOptions& box) {
  if (any_wall_moves(box, scene.dimension) || box.gravity.isZero(0.0)) {
    scene.assembly.pressure =
        t.number("pressure", {kPositive.holds, "a positive number (pressure on the walls during assembly)"})
            .value_or(0);
    return;
  }
  t.refuse("pressure", "box.pressure is not allowed here: no wall moves, and gravity alone loads the grains");
  t.refuse("mass", "box.mass is not allowed here: no wall moves");
  const double a = scene.grains.largest();
  scene.assembly.pressure =
      a > 0.0 ? mass_of(scene, a) * box.gravity.norm() / std::pow(a, scene.dimension - 1) : 1.0;
}

void read_sides(TableReader& t, const Scene& scene, BoxOptions& box) {
  if (scene.starts_from_state())
    return t.refuse("sides",
                    "box.sides is not allowed here: the size of the box comes from the file assembly.state");
  const bool plane = scene.dimension == 2;
  const std::vector<double> sides = t.numbers(
      "sides",
      {kPositive.holds,
       plane ? "two lengths, e.g. [30, 40], of which only the ratio counts if assembly.solid_fraction is given"
             : "three lengths, e.g. [25, 25, 40], of which only the ratios count if assembly.solid_fraction is "
               "given"});
  if (sides.empty()) {
    if (t && !t.has("sides")) t.fault("sides", "box.sides is missing: expected one length for each axis");
    return;
  }
  if (sides.size() != static_cast<std::size_t>(scene.dimension))
    return t.fault("sides", fmt::format("box.sides has {} numbers: expected {}, one for each axis",
                                        sides.size(), scene.dimension));
  for (int a = 0; a < scene.dimension; ++a) box.sides[a] = sides[static_cast<std::size_t>(a)];
}

/// Reads the friction coefficient between grains and walls, and the pull-off force of grains from walls. Both have no
/// default values, because they determine the result and publications often omit them.
void read_contacts(TableReader& t, const Scene& scene, BoxOptions& box) {
  const NumberRule friction{not_negative,
                            "the friction coefficient of grains on walls, a number >= 0 (there is no default, "
                            "because it determines the result)"};
  const NumberRule adhesion{not_negative,
                            "the pull-off force of grains from walls, a number >= 0 (there is no default, "
                            "because it determines the result)"};
  box.friction = t.number("friction", friction).value_or(0);
  box.adhesion = t.number("adhesion", adhesion).value_or(0);
  if (scene.law.adheres_by_itself())
    t.fault("adhesion",
            fmt::format(
                "box.adhesion: with contact.normal.law = \"{}\" grains adhere to walls with the same law as to "
                "each other, so box.adhesion cannot be given; expected a periodic cell, or another contact law",
                scene.law.normal_keyword()));
  // If the grains are rigid, contacts with walls need no stiffness.
  if (box.friction > 0 && !scene.law.has_friction() && !scene.law.is_rigid())
    t.fault(
        "friction",
        fmt::format("box.friction = {}: walls use the tangential stiffness of the friction between grains, but "
                    "the grains have no friction; expected a table contact.friction, or box.friction = 0",
                    box.friction));
}

/// Checks that the box is large enough for its grains to be placed in it at random.
void check_room(TableReader& t, const Scene& scene, const BoxOptions& box) {
  const double d = scene.grains.largest();
  if (scene.starts_from_state() || !(d > 0) || scene.grains.count == 0) return;
  if (scene.assembly.solid_fraction == 0.0)
    for (int a = 0; a < scene.dimension; ++a)
      if (!(box.sides[a] > d))
        return t.fault(
            "sides",
            fmt::format(
                "box.sides: the side {} along axis {} is too short; expected more than the largest diameter {}",
                box.sides[a], a + 1, d));
  // Lower bound on the volume of the grains: every grain is counted with the smallest diameter.
  const double least = std::pow(scene.grains.smallest(), scene.dimension) * std::numbers::pi /
                       (scene.dimension == 2 ? 4.0 : 6.0) * scene.grains.count;
  const double volume = box.sides.head(scene.dimension).prod();
  const double densest = scene.dimension == 2 ? kDensestGasOfDisks : kDensestGasOfSpheres;
  if (scene.assembly.solid_fraction == 0.0 && least > densest * volume)
    t.fault("sides",
            fmt::format("box.sides: the {} grains fill at least {:.3g} of the volume of the box, but they can "
                        "be placed at random without overlap only up to the fraction {}; expected longer sides",
                        scene.grains.count, least / volume, densest));
}

}  // namespace

void read_boxed_gas(TableReader& assembly, Scene& scene) {
  scene.assembly.box.emplace();
  BoxOptions& box = *scene.assembly.box;
  assembly.refuse(
      "pressure",
      "assembly.pressure is not allowed here: in a scene with walls the pressure is given by box.pressure");
  box.kinetic_pressure = assembly
                             .number("kinetic_pressure",
                                     {not_negative,
                                      "the kinetic pressure of the gas, a number >= 0: density of the gas "
                                      "times squared speed of its grains"},
                                     Need::optional)
                             .value_or(0);
  if (scene.starts_from_state()) {
    assembly.refuse("solid_fraction",
                    "assembly.solid_fraction is not allowed here: the box and its grains come from the file "
                    "assembly.state");
    assembly.refuse(
        "kinetic_pressure",
        "assembly.kinetic_pressure is not allowed here: the grains of the file assembly.state start at rest");
    return;
  }
  // At solid fractions above the accepted interval, grains cannot be placed at random without overlap.
  const bool plane = scene.dimension == 2;
  scene.assembly.solid_fraction =
      assembly
          .number("solid_fraction",
                  plane ? NumberRule{[](double x) { return x > 0 && x <= kDensestGasOfDisks; },
                                     "the solid fraction of the gas in (0, 0.6]; if it is given, only the "
                                     "ratios of box.sides count"}
                        : NumberRule{[](double x) { return x > 0 && x <= kDensestGasOfSpheres; },
                                     "the solid fraction of the gas in (0, 0.49]; if it is given, only the "
                                     "ratios of box.sides count"},
                  Need::optional)
          .value_or(0);
}

void read_box(TableReader& root, Scene& scene) {
  TableReader t = root.table("box", "a table [box]");
  BoxOptions& box = *scene.assembly.box;
  read_boundary(t, scene.dimension, box);
  read_sides(t, scene, box);
  read_contacts(t, scene, box);
  // Without gravity, at least one axis must have walls that can move, because fixed walls and periodic boundaries do
  // not respond to the pressure.
  read_gravity(t, scene.dimension, box);
  if (!any_wall_moves(box, scene.dimension) && box.gravity.isZero(0.0))
    t.fault("boundary",
            "box.boundary: no wall can move under the pressure; expected \"walls\" for at least one axis, a "
            "floor with box.gravity, or a table [cell] in place of [box]");
  read_pressure(t, scene, box);
  if (any_wall_moves(box, scene.dimension) || box.gravity.isZero(0.0))
    box.mass = t.number("mass", {kPositive.holds,
                                 "a positive number (mass of a wall divided by the mass of the largest grain)"})
                   .value_or(1);
  scene.assembly.cell.wall_speed = t.number("speed",
                                            {kPositive.holds,
                                             "a positive number (speed at which opposite walls approach each "
                                             "other until the grains carry the pressure)"},
                                            Need::optional);
  if (std::any_of(box.boundary.begin(), box.boundary.begin() + scene.dimension,
                  [](BoxSide side) { return side == BoxSide::floor || side == BoxSide::lid; }))
    t.refuse("speed",
             "box.speed is not allowed here: it is the speed of opposite walls, but a floor does not move");
  check_room(t, scene, box);
  t.refuse_other_keys();
}

void read_compaction_end(TableReader& t, Scene& scene) {
  CompactionEnd& end = scene.relaxation.compaction;
  if (!scene.assembly.box) {
    for (const char* key : {"end", "energy_ratio", "stop_time"})
      t.refuse(key, fmt::format("{} is not allowed here: it defines when the compaction between walls ends, "
                                "but the scene has no table [box]",
                                t.path_of(key)));
    return;
  }
  // Between walls this value is the default tolerance of the stress. The key equilibrium.stress is read after this
  // function and replaces the default.
  scene.relaxation.tolerance.stress = CompactionEnd::kSettledPressure;
  if (scene.law.is_rigid()) {
    for (const char* key : {"end", "energy_ratio", "stop_time"})
      t.refuse(key,
               fmt::format("{} is not allowed with rigid contacts: the compaction of rigid grains ends when "
                           "the forces on all grains and walls balance; remove the key",
                           t.path_of(key)));
    return;
  }
  const auto chosen = t.choice("end", {"settled", "energy_ratio"}, Need::optional);
  if (chosen && *chosen == 1) end.criterion = CompactionEnd::Criterion::energy_ratio;
  // The key is read even if the criterion does not use it. A key that is not read would be reported as unknown, whereas
  // the message below names the criterion that needs the key.
  end.energy_ratio = t.number("energy_ratio",
                              {kPositive.holds, "a positive number (kinetic energy divided by elastic energy)"},
                              Need::optional)
                         .value_or(end.energy_ratio);
  if (t.has("energy_ratio") && end.criterion != CompactionEnd::Criterion::energy_ratio)
    t.fault(
        "energy_ratio",
        "equilibrium.energy_ratio is used only with equilibrium.end = \"energy_ratio\": expected this value of "
        "equilibrium.end, or no key energy_ratio");
  end.longest =
      t.number("stop_time",
               {kPositive.holds,
                "a positive number (time after which the state is recorded even if the packing still moves, in "
                "units of sqrt(m/(P a^(d-2))): largest mass m, pressure P, largest diameter a, "
                "dimension d)"},
               Need::optional);
}

}  // namespace floc
