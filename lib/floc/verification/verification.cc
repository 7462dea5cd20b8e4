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
#include "floc/packing/law/contact_response.h"
#include "floc/packing/law/stiffness_check.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/wall_forces.h"
#include "floc/verification/common_criteria.h"
#include "floc/verification/contact_check.h"
#include "floc/verification/rigid_geometry.h"
#include "floc/verification/shape_criteria.h"
#include "floc/verification/violations.h"

namespace floc {
namespace {

/// Identity of a pair of grains: their indices and the periodic image. The identity does not change if the two grains
/// are exchanged and the periodic image is reversed.
using PairIdentity = std::tuple<int, int, std::vector<int>>;

template <class Pair>
PairIdentity identity(Pair pair) {
  pair = canonical(std::move(pair));
  return {pair.i, pair.j, {pair.image.begin(), pair.image.end()}};
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
      violations.add(error, fmt::format("{} by {:.2g}", pair_name(recomputed, c), error));
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
      wrong(pair_name(recomputed, c) + " are in the contact list twice");
    if (c.distant && c.gap >= recomputed.law_of(c).range() + open && bridge_volume(recomputed, c) == 0.0)
      wrong(fmt::format("{} are in the contact list although they do not interact at their gap of {:.2g}",
                        pair_name(recomputed, c), c.gap));
  }
  // Several contacts of one pair of grains are distinguished by the keys 0, 1, ...
  for (const Contact<Dim>& c : recomputed.contacts)
    if (c.key < 0 || (c.key > 0 && !listed.contains({identity(c), c.key - 1})))
      wrong(fmt::format("{} are in the contact list with the key {}, but not with the preceding key",
                        pair_name(recomputed, c), c.key));
  for (const Contact<Dim>& c : missing_contacts(recomputed, open))
    wrong(fmt::format("{} are missing in the contact list although they interact at their gap of {:.2g}",
                      pair_name(recomputed, c), c.gap));
  return {"list", static_cast<double>(n_wrong), 0.0, n_wrong == 0, violations.worst_first()};
}

/// Checks the liquid bridges of a state. Their total volume must be the volume that the contact law gives. As a test,
/// the liquid is distributed once more: the number of bridges that change must equal the number recorded in the state.
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

/// Returns the largest accepted relative difference between a stored stiffness and the stiffness that the contact law
/// gives.
///   - Surfaces that touch have a constant stiffness, or a stiffness that is computed from a root of the elastic force.
///     The rounding error is about 1e-15, even after a change of units.
///   - The stiffness of an attraction across a gap depends on the gap, and an error of the gap causes an error of the
///     stiffness. The ratio of the stiffness kn to the force is the relative rate at which the force decreases with the
///     gap; the relative rate of decrease of kn is at most three times this ratio.
template <int Dim>
double stiffness_tolerance(const Packing<Dim>& packing, const Contact<Dim>& c) {
  constexpr double kRelative = 1e-12;
  constexpr double kSteepest = 3.0;
  if (!c.distant || c.normal_force == 0.0) return kRelative;
  return kRelative + kSteepest * std::abs(c.kn / c.normal_force) * distance_error(packing);
}

/// Returns a description of the first stiffness of a stored contact that differs from the contact law. Returns an empty
/// text if all stiffnesses agree.
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
    // The moments are divided by the length of arm_i - arm_j, the vector from the first body to the second, so that all
    // errors are forces.
    const double error =
        std::max({std::abs(c.normal_force - r.normal_force), std::abs(c.elastic_force - r.elastic_force),
                  (c.shear_force - r.shear_force).norm(), (c.rolling_moment - r.rolling_moment).norm() / arm,
                  std::abs(c.twisting_moment - r.twisting_moment) / arm});
    result.value = std::max(*result.value, error);
    std::string state = wrong_stiffness(recomputed, c, stiffness_tolerance(recomputed, r));
    if (!state.empty()) state = "the stiffness " + state;
    // The law computes the stiffness of a contact according to its mark (touching or distant), so a wrong mark can be
    // the cause of a wrong stiffness. If the mark is wrong, the message therefore names the mark and not the stiffness.
    if (c.distant != r.distant)
      state = fmt::format("the contact being stored as {} although its gap is {:.2g}",
                          c.distant ? "distant" : "touching", r.gap);
    if (!(error <= result.limit))
      violations.add(error, fmt::format("{} by {:.2g}", pair_name(recomputed, c), error));
    else if (!state.empty())
      violations.add(0.0, fmt::format("{} by {}", pair_name(recomputed, c), state));
  }
  result.where = violations.worst_first();
  result.holds = result.where.empty();
  result.by_value = !(result.value <= result.limit);
  return result;
}

/// Recomputes the contacts of a packing, and adds the criteria geometry and list.
template <int Dim>
void add_geometry(const Packing<Dim>& stored, Packing<Dim>& recomputed, std::vector<Criterion>& criteria) {
  if (stored.grains.are_round()) {
    for (Contact<Dim>& c : recomputed.contacts) refresh_contact(recomputed, c);
    criteria = {check_geometry(stored, recomputed), check_list(recomputed)};
    return;
  }
  // Two shapes may have several contact points. Each point keeps its springs, and the law gives the forces at the
  // point.
  const RigidGeometry<Dim> geometry = rigid_geometry(stored, 0.0, relative_distance_error(stored));
  criteria = {check_shape_geometry(stored, geometry.recorded), check_shape_list(stored, geometry)};
  recomputed.contacts = geometry.recorded;
  const std::vector<SurfaceMotion<Dim>> unmoved(recomputed.contacts.size());
  respond<Dim>(recomputed, unmoved, recomputed.contacts);
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
  std::vector<Criterion> criteria;
  add_geometry(state.packing, recomputed, criteria);
  criteria.push_back(check_law(state.packing, recomputed));
  const Mat<Dim> stress = static_stress(recomputed);
  add_residuals(state, recomputed, stress, "the grains are still moving", criteria);
  add_lengths(state, criteria);
  criteria.push_back(check_recorded_stress(state, recomputed, stress));
  const Stability found = stability_at_rest(recomputed);
  criteria.push_back(check_stability(found));
  criteria.push_back(check_boundary(state, recomputed, stress));
  criteria.push_back(check_record(state, recomputed, stress, found.n_negative));
  criteria.push_back(check_liquid(state, recomputed));
  return criteria;
}

template std::vector<Criterion> verify_equilibrium(const State<2>&);
template std::vector<Criterion> verify_equilibrium(const State<3>&);

}  // namespace floc
