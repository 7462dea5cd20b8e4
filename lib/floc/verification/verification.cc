#include "floc/verification/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "floc/elasticity/stability.h"
#include "floc/neighbors/spread_liquid.h"
#include "floc/packing/balance.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/law/stiffness_check.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/wall_forces.h"
#include "floc/verification/contact_check.h"

namespace floc {
namespace {

/// Identity of a pair of grains: their indices and the periodic image. It depends neither on the order of the two
/// grains nor on the choice between opposite images.
using PairIdentity = std::tuple<int, int, std::vector<int>>;

template <class Pair>
PairIdentity identity(Pair pair) {
  pair = canonical(std::move(pair));
  return {pair.i, pair.j, {pair.image.begin(), pair.image.end()}};
}

constexpr std::size_t kMaxListed = 5;  ///< largest number of violations that a message lists

/// Grains or contacts that violate a criterion, each with the size of its violation.
class Violations {
 public:
  void add(double how_bad, std::string name) { found_.emplace_back(how_bad, std::move(name)); }

  std::string worst_first() {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::string text;
    for (std::size_t k = 0; k < std::min(kMaxListed, found_.size()); ++k)
      text += fmt::format("{}{}", k == 0 ? "" : ", ", found_[k].second);
    if (found_.size() > kMaxListed) text += fmt::format(" and {} more", found_.size() - kMaxListed);
    return text;
  }

 private:
  std::vector<std::pair<double, std::string>> found_;
};

template <int Dim>
std::string name_of(const Packing<Dim>& packing, const Contact<Dim>& c) {
  const Grains<Dim>& g = packing.grains;
  if (packing.is_wall(c.j)) return fmt::format("grain {} and wall {}", g.name(c.i), c.j - g.size());
  return fmt::format("grains {}-{}", g.name(c.i), g.name(c.j));
}

template <int Dim>
Criterion check_geometry(const Packing<Dim>& stored, const Packing<Dim>& recomputed) {
  Criterion result{"geometry", 0.0, distance_error(stored), true, ""};
  Violations violations;
  for (std::size_t k = 0; k < stored.contacts.size(); ++k) {
    const Contact<Dim>& c = stored.contacts[k];
    const Contact<Dim>& r = recomputed.contacts[k];
    const double error =
        std::max(std::abs(c.gap - r.gap), (c.normal - r.normal).norm() * branch(recomputed, r).norm());
    result.value = std::max(*result.value, error);
    if (!(error <= result.limit))
      violations.add(error, fmt::format("{} by {:.2g}", name_of(recomputed, c), error));
  }
  result.where = violations.worst_first();
  result.holds = result.where.empty();
  return result;
}

template <int Dim>
Criterion check_list(const Packing<Dim>& recomputed) {
  const double open = distance_error(recomputed);
  Violations violations;
  std::set<std::pair<PairIdentity, int>> listed;
  int n_wrong = 0;
  const auto wrong = [&](const std::string& what) { violations.add(0.0, what), ++n_wrong; };
  for (const Contact<Dim>& c : recomputed.contacts) {
    if (!listed.insert({identity(c), c.key}).second)
      wrong(name_of(recomputed, c) + " are in the contact list twice");
    if (c.distant && c.gap >= recomputed.law_of(c).range() + open && bridge_volume(recomputed, c) == 0.0)
      wrong(fmt::format("{} are in the contact list although they do not interact at their gap of {:.2g}",
                        name_of(recomputed, c), c.gap));
  }
  // Several contacts of one pair of grains are distinguished by the keys 0, 1, ...
  for (const Contact<Dim>& c : recomputed.contacts)
    if (c.key < 0 || (c.key > 0 && !listed.contains({identity(c), c.key - 1})))
      wrong(fmt::format("{} are in the contact list with the key {}, but not with the key before it",
                        name_of(recomputed, c), c.key));
  for (const Contact<Dim>& c : missing_contacts(recomputed, open))
    wrong(fmt::format("{} are missing in the contact list although they interact at their gap of {:.2g}",
                      name_of(recomputed, c), c.gap));
  return {"list", static_cast<double>(n_wrong), 0.0, n_wrong == 0, violations.worst_first()};
}

/// Checks the liquid bridges of a state. Their total volume must be the volume that the contact law gives, and
/// distributing the liquid once more must change only as many bridges as the state records.
template <int Dim>
Criterion check_liquid(const State<Dim>& state, const Packing<Dim>& recomputed) {
  if (!holds_liquid(recomputed)) return {"liquid", 0.0, 0.0, true, ""};
  constexpr double kRelative = 1e-12;
  const double all = BridgeSearch(*recomputed.law.liquid(), recomputed.grains.radius).liquid();
  double sum = 0.0;
  for (const Contact<Dim>& c : recomputed.contacts) sum += std::abs(bridge_volume(recomputed, c));
  Packing<Dim> shared = recomputed;
  const int n_changed = spread_liquid(shared).n_changed();
  const int recorded = std::max(state.n_bridges_unsettled, 0);
  std::string where;
  if (sum != 0.0 && !(std::abs(sum - all) <= kRelative * all))
    where = fmt::format("the liquid bridges have the total volume {:.6g}, but the contact law gives {:.6g}",
                        sum, all);
  if (n_changed != recorded)
    where += fmt::format(
        "{}{} liquid bridges would change if the liquid were distributed once more, but {} are recorded",
        where.empty() ? "" : ", ", n_changed, recorded);
  return {"liquid", static_cast<double>(n_changed), static_cast<double>(recorded), where.empty(), where};
}

/// Returns a bound on the error of a contact force (force) that results from rounding of the positions.
template <int Dim>
double force_error(const Packing<Dim>& packing) {
  double largest = 0.0;
  double stiffest = 0.0;
  for (const Contact<Dim>& c : packing.contacts) {
    largest = std::max(largest, c.elastic_force);
    stiffest = std::max(stiffest, std::abs(c.kn));
  }
  return stiffest * distance_error(packing) + 1e-12 * largest;
}

/// Returns the largest accepted relative difference between a stored stiffness and the stiffness that the contact law
/// gives.
///   - Surfaces that touch have a constant stiffness, or a stiffness that is computed from the elastic force by a root.
///     The rounding error is about 1e-15, even after a change of units.
///   - The stiffness of an attraction across a gap depends on the gap, and therefore has an error if the gap has one.
///     The ratio of kn to the force is the relative rate at which the force decreases with the gap; kn decreases at up
///     to three times this rate.
template <int Dim>
double stiffness_tolerance(const Packing<Dim>& packing, const Contact<Dim>& c) {
  constexpr double kRelative = 1e-12;
  constexpr double kSteepest = 3.0;
  if (!c.distant || c.normal_force == 0.0) return kRelative;
  return kRelative + kSteepest * std::abs(c.kn / c.normal_force) * distance_error(packing);
}

/// Describes the first stored stiffness of a contact that differs from the contact law. Returns an empty text if all
/// stiffnesses agree.
template <int Dim>
std::string wrong_stiffness(const Packing<Dim>& packing, const Contact<Dim>& stored, double tolerance) {
  const Stiffnesses found = stiffnesses(stored), by_law = law_stiffnesses(packing, stored);
  for (std::size_t k = 0; k < found.size(); ++k)
    if (differ(found[k], by_law[k], tolerance))
      return fmt::format("{} = {:.17g}, but the contact law gives {:.17g}", kStiffnessNames[k], found[k],
                         by_law[k]);
  return "";
}

template <int Dim>
Criterion check_law(const Packing<Dim>& stored, const Packing<Dim>& recomputed) {
  Criterion result{"law", 0.0, force_error(recomputed), true, ""};
  Violations violations;
  for (std::size_t k = 0; k < stored.contacts.size(); ++k) {
    const Contact<Dim>& c = stored.contacts[k];
    const Contact<Dim>& r = recomputed.contacts[k];
    const double arm = (r.arm_i - r.arm_j).norm();
    const double error =
        std::max({std::abs(c.normal_force - r.normal_force), std::abs(c.elastic_force - r.elastic_force),
                  (c.shear_force - r.shear_force).norm(), (c.rolling_moment - r.rolling_moment).norm() / arm,
                  std::abs(c.twisting_moment - r.twisting_moment) / arm});
    result.value = std::max(*result.value, error);
    std::string state = wrong_stiffness(recomputed, c, stiffness_tolerance(recomputed, r));
    if (!state.empty()) state = "the stiffness " + state;
    if (c.distant != r.distant)
      state = fmt::format("the contact being stored as {} although its gap is {:.2g}",
                          c.distant ? "distant" : "touching", r.gap);
    if (!(error <= result.limit))
      violations.add(error, fmt::format("{} by {:.2g}", name_of(recomputed, c), error));
    else if (!state.empty())
      violations.add(0.0, fmt::format("{} by {}", name_of(recomputed, c), state));
  }
  result.where = violations.worst_first();
  result.holds = result.where.empty();
  result.by_value = !(result.value <= result.limit);
  return result;
}

/// Lists, in words, the grains whose net force or moment is not below `limit`.
/// @param net  net force or moment of each grain
/// @param unit  function that returns the unit in which the force or moment of a grain is expressed
/// @param limit  largest accepted force or moment, in this unit
template <int Dim, class Vector, class Unit>
std::string unbalanced(const Grains<Dim>& grains, const std::vector<Vector>& net, const Unit& unit,
                       double limit) {
  Violations violations;
  for (std::size_t i = 0; i < net.size(); ++i) {
    const double value = net[i].norm() / unit(static_cast<int>(i));
    if (value >= limit)
      violations.add(value,
                     fmt::format("grain {} with the residual {:.2g}", grains.name(static_cast<int>(i)), value));
  }
  return violations.worst_first();
}

template <int Dim>
void check_residuals(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress,
                     std::vector<Criterion>& criteria) {
  const Residuals r = residuals(recomputed, state.target_stress, stress);
  const EquilibriumTolerance& t = state.tolerance;
  const Balance<Dim> net = net_forces(recomputed);
  const GrainScales<Dim> scales(recomputed, state.target_stress);
  const auto add = [&](const char* name, double value, double limit, std::string where) {
    criteria.push_back({name, value, limit, value < limit, value < limit ? "" : std::move(where)});
  };
  add("force", r.force, t.force,
      unbalanced(
          recomputed.grains, net.force, [&](int i) { return scales.of(i).force; }, t.force));
  add("moment", r.moment, t.moment,
      unbalanced(
          recomputed.grains, net.moment, [&](int i) { return scales.of(i).force * scales.of(i).length; },
          t.moment));
  std::string stresses;
  const bool boxed = !recomputed.walls.empty();
  const Vec<Dim> on_walls = wall_pressure(recomputed);
  for (int a = 0; a < Dim; ++a)
    stresses += fmt::format("{}{}_{} = {:.6g} but the target is {:.6g}", a == 0 ? "" : ", ",
                            boxed ? "pressure on the walls" : "sigma", a + 1,
                            boxed ? on_walls[a] : stress(a, a), state.target_stress[a]);
  add("stress", r.stress, t.stress, stresses);
  add("energy", r.energy, t.energy, "the grains are still moving");
}

/// Compares the offset (component along the first axis) of a sheared lattice vector with the offset imposed by a simple
/// shear, and adds the difference to `result`. The difference is relative to the length of the axis.
template <int Dim>
void check_offset(const State<Dim>& state, double limit, Criterion& result) {
  if (!state.target_offset) return;
  const auto [axis, imposed] = *state.target_offset;
  const Mat<Dim>& lattice = state.packing.cell.matrix;
  const double error = std::abs(lattice(axis, 0) - imposed) / lattice(axis, axis);
  result.value = std::max(*result.value, error);
  if (!(error <= limit))
    result.where += fmt::format("{}the offset of lattice vector L{} is {:.17g}, but {:.17g} was imposed",
                                result.where.empty() ? "" : ", ", axis + 1, lattice(axis, 0), imposed);
}

/// Compares the lengths of the axes of the cell, and the offset of a sheared lattice vector, with the imposed values.
/// Only rounding errors are accepted, because the motion of the cell ends exactly at these values.
template <int Dim>
void check_lengths(const State<Dim>& state, std::vector<Criterion>& criteria) {
  if (state.target_side.isZero(0.0)) return;
  constexpr double kRelative = 1e-12;
  Criterion result{"length", 0.0, kRelative, true, ""};
  for (int a = 0; a < Dim; ++a) {
    const double imposed = state.target_side[a];
    if (imposed == 0.0) continue;
    const double length = state.packing.cell.matrix(a, a);
    const double error = std::abs(length / imposed - 1.0);
    result.value = std::max(*result.value, error);
    if (!(error <= kRelative))
      result.where += fmt::format("{}the length L{} is {:.17g}, but {:.17g} was imposed",
                                  result.where.empty() ? "" : ", ", a + 1, length, imposed);
  }
  check_offset(state, kRelative, result);
  result.holds = result.where.empty();
  criteria.push_back(std::move(result));
}

/// Returns all components of a stress tensor as text, row by row.
template <int Dim>
std::string components(const Mat<Dim>& stress) {
  std::string text;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) text += fmt::format("{}{:.6g}", text.empty() ? "" : " ", stress(a, b));
  return text;
}

/// Compares the recorded stress with the stress of the recomputed forces. The difference is divided by the mean stress.
template <int Dim>
Criterion check_recorded_stress(const State<Dim>& state, const Packing<Dim>& recomputed,
                                const Mat<Dim>& stress) {
  constexpr double kRelative = 1e-10;
  double lengths = 0.0;    // sum of the lengths of all branch vectors (from centre to centre)
  double magnitude = 0.0;  // sum of the absolute values of normal force times branch length
  for (const Contact<Dim>& c : recomputed.contacts) {
    const double length = branch(recomputed, c).norm();
    lengths += length;
    magnitude += std::abs(c.normal_force) * length;
  }
  const double volume = recomputed.cell.volume();
  // At zero pressure, tensile and compressive contributions to the stress cancel. The error is then compared with the
  // size of the contributions instead of their sum.
  const double scale = std::max(std::abs(stress.trace() / Dim), 1e-5 * magnitude / (Dim * volume));
  const double error = (state.stress - stress).cwiseAbs().maxCoeff();
  // The normal and the tangential force may each have the error that the criterion "law" accepts.
  const double limit = kRelative * scale + 2.0 * force_error(recomputed) * lengths / volume;
  const bool holds = error <= limit;
  const double unit = scale > 0.0 ? scale : 1.0;
  return {"mean_stress", error / unit, limit / unit, holds,
          holds ? ""
                : fmt::format("the recorded stress is {}, but the recomputed stress is {}",
                              components<Dim>(state.stress), components(stress))};
}

/// Compares the stress that the forces across the faces of the cell give with the stress of all contacts. Net forces on
/// grains cause a part of the difference (see boundary_stress()). The net force of each grain is accepted as a cause
/// only up to the tolerance of forces, because a larger net force is no equilibrium.
template <int Dim>
Criterion check_boundary(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress) {
  const Grains<Dim>& g = recomputed.grains;
  const Balance<Dim> net = net_forces(recomputed);
  const double largest = state.tolerance.force * force_scale(recomputed, state.target_stress).force;
  Vec<Dim> centre = Vec<Dim>::Zero();
  if (recomputed.walls.empty())
    for (const Vec<Dim>& x : g.position) centre += x / g.size();
  double open = 0.0;  // difference that net forces within their tolerance explain (force * length)
  for (int i = 0; i < g.size(); ++i)
    open += std::min(net.force[i].norm(), largest) * (g.position[i] - centre).norm();
  double rounded = 0.0;
  for (const Contact<Dim>& c : recomputed.contacts) {
    const double force = std::abs(c.normal_force) + c.shear_force.norm();
    const double to_j = recomputed.is_wall(c.j) ? branch(recomputed, c).norm() : g.position[c.j].norm();
    rounded += force * (recomputed.cell.shift(c.image).norm() + g.position[c.i].norm() + to_j);
  }
  const Mat<Dim> across = boundary_stress(recomputed);
  const double volume = recomputed.cell.volume();
  const double limit = (open + 64.0 * std::numeric_limits<double>::epsilon() * rounded) / volume;
  const double error = (across - stress).cwiseAbs().maxCoeff();
  const bool holds = error <= limit;
  return {"boundary_balance", error, limit, holds,
          holds ? ""
                : fmt::format(
                      "the stress from the forces across the faces is {}, but the stress of all contacts is {}",
                      components(across), components(stress))};
}

/// Comparison of recorded quantities of a state, other than forces, with the values that follow from the recomputed
/// forces. It counts the differences and describes the first of them.
class Record {
 public:
  /// Compares the recorded value of one quantity with the value `found`, which follows from the recomputed forces.
  /// @param rounding  bound on the error of `found` that results from rounding of the positions
  void compare(const char* name, double recorded, double found, double rounding) {
    constexpr double kRelative = 1e-6;  // sums computed by another compiler are rounded differently
    const double size = std::max(std::abs(recorded), std::abs(found));
    if (recorded == found || std::abs(recorded - found) <= kRelative * size + rounding) return;
    wrong(fmt::format("{} is recorded as {:.3g}, but its value is {:.3g}", name, recorded, found));
  }
  void wrong(std::string what) { found_.add(0.0, std::move(what)), ++n_; }

  Criterion criterion() { return {"recorded", static_cast<double>(n_), 0.0, n_ == 0, found_.worst_first()}; }

 private:
  Violations found_;
  int n_ = 0;
};

/// Largest distance of a force from its limit, relative to the limit, at which a contact may be flagged as mobilised
/// (sliding or yielding). Files of other programs print at least six digits.
constexpr double kFlagTolerance = 1e-5;
/// A contact must be flagged as mobilised (sliding or yielding) if the distance of its force from the limit, relative
/// to the limit, is smaller than this.
constexpr double kAtCap = 1e-13;

template <int Dim>
void compare_flags(const Packing<Dim>& stored, Record& record) {
  const auto compare = [&](const Contact<Dim>& c, const char* flag, bool recorded, bool near, bool at) {
    if (recorded ? !near : at)
      record.wrong(fmt::format("{} are recorded as {}{}, but their forces show the opposite",
                               name_of(stored, c), recorded ? "" : "not ", flag));
  };
  for (const Contact<Dim>& c : stored.contacts) {
    const Law& law = stored.law_of(c);
    const Mobilised near = mobilised(law, c, kFlagTolerance), at = mobilised(law, c, kAtCap);
    compare(c, "sliding", c.sliding, near.sliding, at.sliding);
    compare(c, "yielding in rolling", c.rolling_yield, near.rolling, at.rolling);
    compare(c, "yielding in twisting", c.twisting_yield, near.twisting, at.twisting);
  }
}

/// Compares the residuals of the grains that are recorded as the worst ones with the largest residuals of all grains.
/// @param found  largest residuals of the recomputed packing
/// @param rounding  bound on the rounding error of a residual
template <int Dim>
void compare_worst_grains(const State<Dim>& state, const Packing<Dim>& recomputed, const Residuals& found,
                          double rounding, Record& record) {
  const Balance<Dim> net = net_forces(recomputed);
  const GrainScales<Dim> scales(recomputed, state.target_stress);
  if (!(scales.of_packing().force > 0.0)) return;
  const auto compare = [&](const char* name, int i, double largest, const auto& residual) {
    if (i >= recomputed.grains.size())
      record.wrong(fmt::format("{} is recorded as {}: expected the number of a grain", name, i));
    else if (i >= 0)  // a negative number means that no grain is recorded
      record.compare(name, residual(i), largest, rounding);
  };
  compare("the residual of the grain worst_force_grain", state.residuals.worst_force_grain, found.force,
          [&](int i) { return net.force[i].norm() / scales.of(i).force; });
  compare("the residual of the grain worst_moment_grain", state.residuals.worst_moment_grain, found.moment,
          [&](int i) { return net.moment[i].norm() / (scales.of(i).force * scales.of(i).length); });
}

/// Compares the recorded forces on walls with the contact forces on these walls, and the recorded rates at which the
/// sides of a box change with the velocities of its walls.
template <int Dim>
void compare_walls(const State<Dim>& state, const Packing<Dim>& recomputed, Record& record) {
  const std::vector<double> found = wall_forces(recomputed);
  const double open = static_cast<double>(recomputed.contacts.size()) * force_error(recomputed);
  for (std::size_t w = 0; w < state.wall_force.size(); ++w)
    record.compare("walls/force", state.wall_force[w], found[w], open);
  for (int a = 0; a < Dim; ++a) {
    if (!between_walls(recomputed.walls, a)) continue;
    double rate = 0.0, speed = 0.0;
    for (const Wall<Dim>& wall : recomputed.walls)
      if (wall.axis == a) rate += wall.side * wall.velocity, speed += std::abs(wall.velocity);
    record.compare("cell/velocity", recomputed.cell.velocity(a, a), rate, 1e-12 * speed);
  }
}

template <int Dim>
void compare_orientations(const Grains<Dim>& grains, Record& record) {
  // Rounding in many time steps may change the norm of a unit quaternion by this much.
  constexpr double kRounding = 1e-9;
  if constexpr (Dim == 3)
    for (int i = 0; i < grains.size(); ++i)
      if (!(std::abs(grains.orientation[i].norm() - 1.0) <= kRounding))
        record.wrong(
            fmt::format("the orientation of grain {} is recorded with the norm {:.9g}, but a unit quaternion "
                        "has the norm 1",
                        grains.name(i), grains.orientation[i].norm()));
}

/// Compares the recorded residuals, number of negative eigenvalues, worst grains, flags, wall forces and orientations
/// with the values that follow from the recomputed forces.
template <int Dim>
Criterion check_record(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress,
                       const Stability& tested) {
  Record record;
  const Residuals found = residuals(recomputed, state.target_stress, stress);
  const ForceScale scale = force_scale(recomputed, state.target_stress);
  constexpr double kContacts = 8.0;  // assumed number of contacts of a grain, whose errors add up
  const double open = scale.force > 0.0 ? kContacts * force_error(recomputed) / scale.force : 0.0;
  record.compare("residuals.force", state.residuals.force, found.force, open);
  record.compare("residuals.moment", state.residuals.moment, found.moment, open);
  double lengths = 0.0;
  for (const Contact<Dim>& c : recomputed.contacts) lengths += branch(recomputed, c).norm();
  // With walls, the residual of the stress is in units of the pressure.
  const bool by_pressure = !recomputed.walls.empty() && state.target_stress.mean() > 0.0;
  const double unit = by_pressure ? state.target_stress.mean() : scale.force / std::pow(scale.length, Dim - 1);
  record.compare(
      "residuals.stress", state.residuals.stress, found.stress,
      unit > 0.0 ? kContacts * force_error(recomputed) * lengths / (recomputed.cell.volume() * unit) : 0.0);
  record.compare("residuals.energy", state.residuals.energy, found.energy, 0.0);
  if (state.n_negative >= 0 && tested.n_negative && state.n_negative != *tested.n_negative)
    record.wrong(
        fmt::format("n_negative is recorded as {}, but its value is {}", state.n_negative, *tested.n_negative));
  compare_worst_grains(state, recomputed, found, open, record);
  compare_flags(state.packing, record);
  compare_walls(state, recomputed, record);
  compare_orientations(recomputed.grains, record);
  return record.criterion();
}

Criterion check_stability(const Stability& found) {
  const bool holds = found.may_be_stable();
  std::string where = found.note;
  if (!holds && where.empty())
    where = fmt::format("the stiffness matrix has {} negative eigenvalues", *found.n_negative);
  return {"stability", found.n_negative, 0.0, holds, where};
}

}  // namespace

template <int Dim>
std::vector<Criterion> verify_equilibrium(const State<Dim>& state) {
  Packing<Dim> recomputed = state.packing;
  for (Contact<Dim>& c : recomputed.contacts) refresh_contact(recomputed, c);
  std::vector<Criterion> criteria = {check_geometry(state.packing, recomputed), check_list(recomputed),
                                     check_law(state.packing, recomputed)};
  const Mat<Dim> stress = static_stress(recomputed);
  check_residuals(state, recomputed, stress, criteria);
  check_lengths(state, criteria);
  criteria.push_back(check_recorded_stress(state, recomputed, stress));
  const Stability found = stability_at_rest(recomputed);
  criteria.push_back(check_stability(found));
  criteria.push_back(check_boundary(state, recomputed, stress));
  criteria.push_back(check_record(state, recomputed, stress, found));
  criteria.push_back(check_liquid(state, recomputed));
  return criteria;
}

template std::vector<Criterion> verify_equilibrium(const State<2>&);
template std::vector<Criterion> verify_equilibrium(const State<3>&);

}  // namespace floc
