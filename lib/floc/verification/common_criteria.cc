#include "floc/verification/common_criteria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/wall_forces.h"
#include "floc/verification/contact_check.h"
#include "floc/verification/violations.h"

namespace floc {
namespace {

/// Returns a text that lists the grains whose net force or moment is not below `limit`.
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

}  // namespace

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

template <int Dim>
void add_residuals(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress,
                   const std::string& motion, std::vector<Criterion>& criteria) {
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
  add("energy", r.energy, t.energy, motion);
}

namespace {

/// For a simple shear, compares the offset (component along the first axis) of the sheared lattice vector with the
/// imposed offset, and adds the difference, divided by the length of the axis, to `result`.
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

}  // namespace

template <int Dim>
void add_lengths(const State<Dim>& state, std::vector<Criterion>& criteria) {
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

namespace {

/// Returns all components of a stress tensor as text, row by row.
template <int Dim>
std::string components(const Mat<Dim>& stress) {
  std::string text;
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) text += fmt::format("{}{:.6g}", text.empty() ? "" : " ", stress(a, b));
  return text;
}

}  // namespace

template <int Dim>
Criterion check_recorded_stress(const State<Dim>& state, const Packing<Dim>& recomputed,
                                const Mat<Dim>& stress) {
  constexpr double kRelative = 1e-10;
  double lengths = 0.0;    // sum of the lengths of all branch vectors (from centre to centre)
  double magnitude = 0.0;  // sum over all contacts of abs(normal force) times branch length
  for (const Contact<Dim>& c : recomputed.contacts) {
    const double length = branch(recomputed, c).norm();
    lengths += length;
    magnitude += std::abs(c.normal_force) * length;
  }
  const double volume = recomputed.cell.volume();
  // At zero pressure, tensile and compressive contributions to the stress cancel. In this case, the error is compared
  // with the sum of the magnitudes of the contributions.
  const double scale = std::max(std::abs(stress.trace() / Dim), 1e-5 * magnitude / (Dim * volume));
  const double error = (state.stress - stress).cwiseAbs().maxCoeff();
  // Both the normal and the tangential force may have the error that the criterion "law" accepts.
  const double limit = kRelative * scale + 2.0 * force_error(recomputed) * lengths / volume;
  const bool holds = error <= limit;
  const double unit = scale > 0.0 ? scale : 1.0;
  return {"mean_stress", error / unit, limit / unit, holds,
          holds ? ""
                : fmt::format("the recorded stress is {}, but the recomputed stress is {}",
                              components<Dim>(state.stress), components(stress))};
}

template <int Dim>
Criterion check_boundary(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress) {
  const Grains<Dim>& g = recomputed.grains;
  const Balance<Dim> net = net_forces(recomputed);
  const double largest = state.tolerance.force * force_scale(recomputed, state.target_stress).force;
  Vec<Dim> centre = Vec<Dim>::Zero();
  if (recomputed.walls.empty())
    for (const Vec<Dim>& x : g.position) centre += x / g.size();
  double open = 0.0;  // largest difference that net forces within their tolerance can cause (force * length)
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

namespace {

/// Compares recorded quantities of a state (other than forces) with the values that follow from the recomputed forces.
/// Counts the differences and describes the first one.
class Record {
 public:
  /// Compares the recorded value of one quantity with the value `found`, which follows from the recomputed forces.
  /// @param rounding  bound on the error of `found` due to the rounding of the positions
  void compare(const char* name, double recorded, double found, double rounding) {
    constexpr double kRelative = 1e-6;  // accepted, because other compilers may round sums differently
    const double size = std::max(std::abs(recorded), std::abs(found));
    if (recorded == found || std::abs(recorded - found) <= kRelative * size + rounding) return;
    const int digits = fmt::format("{:.3g}", recorded) != fmt::format("{:.3g}", found) ? 3 : 9;
    wrong(fmt::format("{} is recorded as {:.{}g}, but its value is {:.{}g}", name, recorded, digits, found,
                      digits));
  }
  void wrong(std::string what) { found_.add(0.0, std::move(what)), ++n_; }

  Criterion criterion() { return {"recorded", static_cast<double>(n_), 0.0, n_ == 0, found_.worst_first()}; }

 private:
  Violations found_;
  int n_ = 0;
};

/// Largest relative difference between a force and its limit at which a contact may be flagged as mobilised (sliding or
/// yielding). The value is sufficient for files of other programs, which contain at least six digits.
constexpr double kFlagTolerance = 1e-5;
/// If the relative difference between a force and its limit is smaller than this value, the contact must be flagged as
/// mobilised (sliding or yielding).
constexpr double kAtCap = 1e-13;

template <int Dim>
void compare_flags(const Packing<Dim>& stored, Record& record) {
  const auto compare = [&](const Contact<Dim>& c, const char* flag, bool recorded, bool near, bool at) {
    if (recorded ? !near : at)
      record.wrong(fmt::format("{} are recorded as {}{}, but their forces show the opposite",
                               pair_name(stored, c), recorded ? "" : "not ", flag));
  };
  for (const Contact<Dim>& c : stored.contacts) {
    const Law& law = stored.law_of(c);
    const Mobilised near = mobilised(law, c, kFlagTolerance), at = mobilised(law, c, kAtCap);
    compare(c, "sliding", c.sliding, near.sliding, at.sliding);
    compare(c, "yielding in rolling", c.rolling_yield, near.rolling, at.rolling);
    compare(c, "yielding in twisting", c.twisting_yield, near.twisting, at.twisting);
  }
}

/// Checks the grains that are recorded as those with the largest residuals: the residuals of these grains must be the
/// largest of all grains.
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

/// Compares the recorded forces on walls with the contact forces on these walls, and the recorded rates of change of
/// the sides with the velocities of the walls.
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
  // Largest change of the norm of a unit quaternion by rounding in many time steps.
  constexpr double kRounding = 1e-9;
  if constexpr (Dim == 3)
    for (int i = 0; i < grains.size(); ++i)
      if (!(std::abs(grains.orientation[i].norm() - 1.0) <= kRounding))
        record.wrong(
            fmt::format("the orientation of grain {} is recorded with the norm {:.9g}, but a unit quaternion "
                        "has the norm 1",
                        grains.name(i), grains.orientation[i].norm()));
}

}  // namespace

template <int Dim>
Criterion check_record(const State<Dim>& state, const Packing<Dim>& recomputed, const Mat<Dim>& stress,
                       const std::optional<int>& n_negative) {
  Record record;
  const Residuals found = residuals(recomputed, state.target_stress, stress);
  const ForceScale scale = force_scale(recomputed, state.target_stress);
  // Assumed number of contacts per grain; the errors of the forces of these contacts add up.
  constexpr double kContacts = 8.0;
  const double open = scale.force > 0.0 ? kContacts * force_error(recomputed) / scale.force : 0.0;
  record.compare("residuals.force", state.residuals.force, found.force, open);
  record.compare("residuals.moment", state.residuals.moment, found.moment, open);
  double lengths = 0.0;
  for (const Contact<Dim>& c : recomputed.contacts) lengths += branch(recomputed, c).norm();
  // For packings with walls, the unit of the stress residual is the pressure.
  const bool by_pressure = !recomputed.walls.empty() && state.target_stress.mean() > 0.0;
  const double unit = by_pressure ? state.target_stress.mean() : scale.force / std::pow(scale.length, Dim - 1);
  record.compare(
      "residuals.stress", state.residuals.stress, found.stress,
      unit > 0.0 ? kContacts * force_error(recomputed) * lengths / (recomputed.cell.volume() * unit) : 0.0);
  record.compare("residuals.energy", state.residuals.energy, found.energy, 0.0);
  if (state.n_negative >= 0 && n_negative && state.n_negative != *n_negative)
    record.wrong(
        fmt::format("n_negative is recorded as {}, but its value is {}", state.n_negative, *n_negative));
  compare_worst_grains(state, recomputed, found, open, record);
  compare_flags(state.packing, record);
  compare_walls(state, recomputed, record);
  compare_orientations(recomputed.grains, record);
  return record.criterion();
}

#define FLOC_INSTANTIATE(Dim)                                                                              \
  template double force_error(const Packing<Dim>&);                                                        \
  template void add_residuals(const State<Dim>&, const Packing<Dim>&, const Mat<Dim>&, const std::string&, \
                              std::vector<Criterion>&);                                                    \
  template void add_lengths(const State<Dim>&, std::vector<Criterion>&);                                   \
  template Criterion check_recorded_stress(const State<Dim>&, const Packing<Dim>&, const Mat<Dim>&);       \
  template Criterion check_boundary(const State<Dim>&, const Packing<Dim>&, const Mat<Dim>&);              \
  template Criterion check_record(const State<Dim>&, const Packing<Dim>&, const Mat<Dim>&,                 \
                                  const std::optional<int>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
