#include "floc/verification/verify_rigid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "floc/geometry/frame.h"
#include "floc/packing/balance.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/rigid/contact_dynamics.h"
#include "floc/verification/common_criteria.h"
#include "floc/verification/contact_check.h"
#include "floc/verification/rigid_geometry.h"
#include "floc/verification/shape_criteria.h"
#include "floc/verification/violations.h"

namespace floc {
namespace {

/// Largest accepted violation of the contact law of rigid grains, divided by the mean normal force. The forces of a run
/// are a few digits more accurate than this limit.
constexpr double kForceError = 1e-9;
/// Largest force (repulsive or tangential) of a contact that counts as zero, divided by the mean repulsive force.
constexpr double kCarries = 1e-9;
/// Deepest overlap of grains in motion, divided by the diameter of the smaller grain.
constexpr double kDeepestInMotion = 5e-2;

/// Returns the mean repulsive force, by which errors of forces are divided; 1 if no force is repulsive.
template <int Dim>
double mean_force(const Packing<Dim>& packing) {
  const double mean = mean_repulsive_force(packing);
  return mean > 0.0 ? mean : 1.0;
}

/// Returns the name of a property of `c` that a rigid contact cannot have; empty if `c` has no such property.
template <int Dim>
std::string elastic_property(const Contact<Dim>& c) {
  if (c.kn != 0.0 || c.kt != 0.0 || c.kr != 0.0 || c.ktw != 0.0)
    return fmt::format("the stiffness {:.3g}", std::max({c.kn, c.kt, c.kr, c.ktw}));
  if (!c.rolling_moment.isZero(0.0) || c.twisting_moment != 0.0) return "a moment";
  if (c.distant) return "an attraction across a gap";
  return "";
}

/// Checks that each repulsive force is the normal force plus the adhesion of the law.
/// @param moving  whether the forces are those of a time step. If the gap of a contact closes in this step, its
/// adhesion acts only from the next step on
template <int Dim>
Criterion check_law(const Packing<Dim>& packing, bool moving) {
  Criterion result{"law", 0.0, kForceError, true, ""};
  Violations violations;
  const double mean = mean_force(packing);
  for (const Contact<Dim>& c : packing.contacts) {
    // Without adhesion, two surfaces that do not press on each other may have a gap between them.
    const double adhesion = pull_off_force(packing, c);
    double error = std::abs(c.elastic_force - c.normal_force - adhesion);
    if (c.elastic_force == 0.0 || (moving && c.gap > 0.0))
      error = std::min(error, std::abs(c.elastic_force - c.normal_force));
    error = std::max(error, std::abs(c.shear_force.dot(c.normal))) / mean;
    result.value = std::max(*result.value, error);
    if (!(error <= result.limit))
      violations.add(error, fmt::format("{} by {:.2g}", pair_name(packing, c), error));
    else if (const std::string property = elastic_property(c); !property.empty())
      violations.add(
          0.0, fmt::format("{} have {}, which rigid contacts do not have", pair_name(packing, c), property));
  }
  return concluded(result, violations);
}

template <int Dim>
Criterion check_cone(const Packing<Dim>& packing) {
  Criterion result{"cone", 0.0, kForceError, true, ""};
  Violations violations;
  const double mean = mean_force(packing);
  for (const Contact<Dim>& c : packing.contacts) {
    const double mu = packing.law_of(c).friction_coefficient();
    const double beyond = (c.shear_force.norm() - mu * std::max(0.0, c.elastic_force)) / mean;
    const double pull = -c.elastic_force / mean;
    result.value = std::max({*result.value, beyond, pull});
    if (!(pull <= result.limit))
      violations.add(pull, fmt::format("{} have a tensile force that exceeds their adhesion by {:.3g}",
                                       pair_name(packing, c), -c.elastic_force));
    else if (!(beyond <= result.limit))
      violations.add(beyond, fmt::format("{} have the tangential force {:.3g}, but its limit is {:.3g}",
                                         pair_name(packing, c), c.shear_force.norm(), mu * c.elastic_force));
  }
  result.where = violations.worst_first();
  result.holds = result.where.empty();
  return result;
}

/// Checks that rigid grains touch where they press on each other (complementarity), and do not overlap.
template <int Dim>
Criterion check_gaps(const Packing<Dim>& recomputed, const RigidGeometry<Dim>& geometry, double tolerance) {
  Criterion result{"gap", geometry.deepest, tolerance, true, ""};
  Violations violations;
  const double least = kCarries * mean_force(recomputed);
  for (const Contact<Dim>& c : recomputed.contacts) {
    if (!(c.elastic_force > least || c.shear_force.norm() > least)) continue;
    const double share = std::abs(c.gap) / (2.0 * smaller_radius(recomputed, c));
    result.value = std::max(*result.value, share);
    if (c.gap > 0.0 && !(share < tolerance))
      violations.add(share,
                     fmt::format("{} carry a force across the gap {:.2g}", pair_name(recomputed, c), c.gap));
  }
  for (const Contact<Dim>& c : geometry.overlapping)
    violations.add(-c.gap / (2.0 * smaller_radius(recomputed, c)),
                   fmt::format("{} overlap by {:.2g}", pair_name(recomputed, c), -c.gap));
  result.where = violations.worst_first();
  result.holds = result.where.empty() && *result.value < tolerance;
  return result;
}

/// Returns the power (energy/time) of the contact forces on the moving grains, the cell and the walls.
template <int Dim>
double contact_power(const Packing<Dim>& packing) {
  const Grains<Dim>& g = packing.grains;
  // Along axes with walls, the velocities of the grains contain the motion of the cell, so the rate of the cell is not
  // added along these axes.
  Mat<Dim> rate = packing.cell.rate();
  for (int a = 0; a < Dim; ++a)
    if (between_walls(packing.walls, a)) rate(a, a) = 0.0;
  double power = 0.0;
  for (const Contact<Dim>& c : packing.contacts) {
    Vec<Dim> u = -g.velocity[c.i] - cross<double>(g.angular_velocity[c.i], c.arm_i);
    if (packing.is_wall(c.j))
      u[packing.wall(c.j).axis] += packing.wall(c.j).velocity;
    else
      u += g.velocity[c.j] + cross<double>(g.angular_velocity[c.j], c.arm_j) + rate * (c.arm_i - c.arm_j);
    power += (c.normal_force * c.normal - c.shear_force).dot(u);
  }
  return power;
}

template <int Dim>
Criterion check_power(const State<Dim>& state, const Packing<Dim>& recomputed) {
  Criterion result{"power", 0.0, state.tolerance.energy, true, ""};
  const double power = contact_power(recomputed);
  if (!(power > 0.0)) return result;
  const ForceScale scale = force_scale(recomputed, state.target_stress);
  const double time = std::sqrt(largest_mass(recomputed.grains) * scale.length / scale.force);
  result.value = power * time / (recomputed.grains.size() * scale.force * scale.length);
  result.holds = *result.value < result.limit;
  if (!result.holds)
    result.where = fmt::format(
        "the contact forces do work on the moving grains at the power {:.3g}, but rigid "
        "contacts only dissipate energy",
        power);
  return result;
}

/// Compares the stored contacts with the contact points that are found in a time step from this packing. The geometry
/// of stored and found contacts must agree up to rounding errors.
template <int Dim>
Criterion check_step_geometry(const Packing<Dim>& stored, const std::vector<Contact<Dim>>& found) {
  Criterion result{"geometry", 0.0, distance_error(stored), true, ""};
  Violations violations;
  for (const Contact<Dim>& c : stored.contacts) {
    const auto at = std::lower_bound(found.begin(), found.end(), c, precedes<Contact<Dim>>);
    if (at == found.end() || precedes(c, *at))
      add_lost_contact(stored, c, violations);
    else
      compare_contact(stored, c, *at, result, violations);
  }
  return concluded(result, violations);
}

/// Returns the packing of a state in motion, prepared for the next time step. It contains all contact points within the
/// reach of this step.
template <int Dim>
ContactDynamics<Dim> step_from(const State<Dim>& state) {
  const MotionRecord& motion = *state.motion;
  BoundaryLoad<Dim> load;
  load.stress = state.target_stress;
  for (int a = 0; a < Dim; ++a) load.under_stress[a] = state.target_side[a] == 0.0;
  load.cell_mass = motion.cell_mass;
  const ContactDynamicsSettings settings{.longest_step = motion.longest_step,
                                         .sweep_tolerance = motion.sweep_tolerance,
                                         .max_sweeps = 1,
                                         .restitution = motion.restitution,
                                         .slow_impact = motion.slow_impact};
  return {state.packing, load, settings, motion.time_step, motion.time_step};
}

/// Checks that the recorded forces are the forces of the time step that begins at the state.
template <int Dim>
Criterion check_step(const State<Dim>& state, double error) {
  // rounding error of the forces in the file, divided by the mean normal force
  constexpr double kRounding = 1e-6;
  const MotionRecord& motion = *state.motion;
  const double limit = std::max(motion.sweep_tolerance, motion.residual) + kRounding;
  const bool holds = error <= limit && std::abs(error - motion.residual) <= kRounding + 1e-2 * motion.residual;
  return {
      "step", error, limit, holds,
      holds ? ""
            : fmt::format(
                  "with the recorded forces, the velocities at the end of the time step of {:.3g} violate the "
                  "conditions of contact by {:.3g} times the mean normal force, but the recorded violation "
                  "is {:.3g}",
                  motion.time_step, error, motion.residual)};
}

/// Returns a text with the name of the grain with the largest kinetic energy.
template <int Dim>
std::string fastest_grain(const Grains<Dim>& grains) {
  int fastest = 0;
  for (int i = 1; i < grains.size(); ++i)
    if (twice_kinetic_energy(grains, i) > twice_kinetic_energy(grains, fastest)) fastest = i;
  return fmt::format("the grains are still moving, most of all grain {} at the velocity {:.3g}",
                     grains.name(fastest), grains.velocity[fastest].norm());
}

}  // namespace

template <int Dim>
std::vector<Criterion> verify_motion(const State<Dim>& state) {
  ContactDynamics<Dim> step = step_from(state);
  Packing<Dim> recomputed = state.packing;
  recomputed.contacts.clear();
  RigidGeometry<Dim> geometry;
  for (const Contact<Dim>& c : step.packing().contacts) {
    if (c.elastic_force != 0.0 || c.normal_force != 0.0) recomputed.contacts.push_back(c);
    const double overlap = -c.gap / (2.0 * smaller_radius(recomputed, c));
    geometry.deepest = std::max(geometry.deepest, overlap);
    if (overlap > kDeepestInMotion) geometry.overlapping.push_back(c);
  }
  std::vector<Criterion> criteria = {check_step_geometry(state.packing, step.packing().contacts),
                                     check_shape_list(state.packing, geometry), check_law(state.packing, true),
                                     check_cone(state.packing)};
  criteria.push_back(check_step(state, step.error_of_forces()));
  criteria.push_back(
      {"overlap", geometry.deepest, kDeepestInMotion, geometry.overlapping.empty(),
       geometry.overlapping.empty() ? "" : "grains overlap more deeply than a time step allows"});
  add_lengths(state, criteria);
  const Mat<Dim> stress = static_stress(recomputed);
  criteria.push_back(check_recorded_stress(state, recomputed, stress));
  criteria.push_back(check_record(state, recomputed, stress, std::nullopt));
  return criteria;
}

template <int Dim>
std::vector<Criterion> verify_rigid(const State<Dim>& state, double gap_tolerance) {
  if (state.motion) return verify_motion(state);
  const RigidGeometry<Dim> geometry =
      rigid_geometry(state.packing, gap_tolerance, relative_distance_error(state.packing));
  Packing<Dim> recomputed = state.packing;
  recomputed.contacts = geometry.recorded;
  std::vector<Criterion> criteria = {check_shape_geometry(state.packing, geometry.recorded),
                                     check_shape_list(state.packing, geometry), check_law(state.packing, false),
                                     check_cone(state.packing),
                                     check_gaps(recomputed, geometry, gap_tolerance)};
  const Mat<Dim> stress = static_stress(recomputed);
  add_residuals(state, recomputed, stress, fastest_grain(state.packing.grains), criteria);
  add_lengths(state, criteria);
  criteria.push_back(check_recorded_stress(state, recomputed, stress));
  criteria.push_back(check_power(state, recomputed));
  criteria.push_back(check_boundary(state, recomputed, stress));
  criteria.push_back(check_record(state, recomputed, stress, std::nullopt));
  return criteria;
}

#define FLOC_INSTANTIATE(Dim)                                       \
  template std::vector<Criterion> verify_motion(const State<Dim>&); \
  template std::vector<Criterion> verify_rigid(const State<Dim>&, double);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
