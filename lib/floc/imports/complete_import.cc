#include "floc/imports/complete_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/version.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/neighbors/spread_liquid.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/overlaps.h"
#include "floc/packing/wall_forces.h"
#include "floc/rigid/near_contacts.h"

namespace floc {
namespace {

/// Default tolerance of force, moment and stress for the equilibrium of an imported packing, in the units of
/// EquilibriumTolerance. Packings of other programs are usually relaxed until the unbalanced forces are below 1e-3.
/// Unbalanced moments of the same order arise because the contact points of other programs are up to one overlap away
/// from those of floc.
constexpr double kForeignTolerance = 1e-3;

/// Returns the tolerances of the equilibrium of an imported packing. The tolerances of force, moment and stress are
///   1. the tolerance that the user gives
///   2. if the user gives none and the file gives the imposed stress: the default of floc
///   3. in all other cases: kForeignTolerance.
/// The tolerance of the energy is proportional to the tolerance of the force.
EquilibriumTolerance tolerance_for(const Imported& imported, const std::optional<double>& tolerance) {
  const EquilibriumTolerance own;
  const double force = tolerance.value_or(imported.target_stress_known ? own.force : kForeignTolerance);
  return {force, force, force, own.energy * (force / own.force)};
}

/// Checks that the solid fraction of a packing is possible.
/// @throws InputError if it is above 1, which is impossible for hard grains
template <int Dim>
void refuse_impossible_density(const std::string& place, const Packing<Dim>& packing) {
  const double phi = solid_fraction(packing);
  if (phi <= 1.0) return;
  throw InputError(
      place, fmt::format("the solid fraction is {:.4g}: expected at most 1. Are the radii in fact diameters "
                         "(--columns diameter=...), or is the cell too small or in another unit of length?",
                         phi));
}

template <int Dim>
void set_target_stress(const Imported& imported, const ImportCompletion& completion, State<Dim>& state) {
  if (completion.stress.empty()) {
    if (!imported.target_stress_known) state.target_stress = load_stress(state.packing).diagonal();
    return;
  }
  if (completion.stress.size() != Dim)
    throw InputError(completion.stress_place,
                     fmt::format("the stress has {} numbers, expected {}", completion.stress.size(), Dim));
  for (int a = 0; a < Dim; ++a) state.target_stress[a] = completion.stress[a];
}

/// Says along which axes a stress that the user gives does not act, because the walls there are fixed.
template <int Dim>
std::string stress_without_effect(const ImportCompletion& completion, const Packing<Dim>& packing) {
  std::string axes;
  for (int a = 0; a < Dim; ++a)
    if (between_walls(packing.walls, a) && n_moving_walls(packing, a) == 0)
      axes += fmt::format("{}{}", axes.empty() ? "" : ",", "xyz"[a]);
  if (completion.stress.empty() || axes.empty()) return "";
  return fmt::format(
      "{} does not act along {}, where no wall follows forces: it is only part of the pressure that is the "
      "unit of the residuals; --wall-masses gives the masses of walls that move",
      completion.stress_place, axes);
}

/// Adds contacts between grains whose surfaces are closer than `gap`. The forces of these contacts are unknown and are
/// set to zero. The stiffnesses are those of the law for surfaces that just touch.
template <int Dim>
void add_touching(double gap, Packing<Dim>& packing) {
  constexpr double kCapTolerance = 1e-6;
  const auto known = packing.contacts;
  add_near_contacts(packing, gap);
  auto next = known.begin();
  for (Contact<Dim>& c : packing.contacts) {
    if (next != known.end() && !precedes(c, *next))
      ++next;
    else
      set_given_forces(packing, {}, {}, kCapTolerance, c), c.bonded = true;
  }
}

/// Finds the contacts of a packing of grains with corners from the geometry, and replaces the contacts in the packing.
template <int Dim>
void find_points(Packing<Dim>& packing) {
  packing.contacts.clear();
  add_near_contacts(packing, 0.0);
  refresh_contacts(packing);
}

/// Finds the contacts of a packing from its geometry. Before the call, the only contacts of the packing are bonds; the
/// bonds are kept.
template <int Dim>
void find_missing_contacts(double touch_gap, Packing<Dim>& packing) {
  std::vector<Contact<Dim>> bonds = std::move(packing.contacts);
  if (packing.grains.are_round())
    find_contacts(packing);
  else
    find_points(packing);
  if (touch_gap > 0.0) add_touching(touch_gap, packing);
  if (bonds.empty()) return;
  std::vector<Contact<Dim>> found = std::move(packing.contacts);
  packing.contacts.clear();
  // If there is a bond between two bodies, it replaces the contact found between them.
  std::set_difference(found.begin(), found.end(), bonds.begin(), bonds.end(),
                      std::back_inserter(packing.contacts), precedes<Contact<Dim>>);
  packing.contacts.insert(packing.contacts.end(), bonds.begin(), bonds.end());
  std::sort(packing.contacts.begin(), packing.contacts.end(), precedes<Contact<Dim>>);
}

/// Finds the contacts of grains with walls from the geometry and adds them to a packing that has no such contacts.
template <int Dim>
void find_wall_contacts(Packing<Dim>& packing) {
  Packing<Dim> found = packing;
  find_contacts(found);
  std::copy_if(found.contacts.begin(), found.contacts.end(), std::back_inserter(packing.contacts),
               [&](const Contact<Dim>& c) { return packing.is_wall(c.j); });
  std::sort(packing.contacts.begin(), packing.contacts.end(), precedes<Contact<Dim>>);
}

}  // namespace

template <int Dim>
std::string complete_import(const std::string& place, const Imported& imported,
                            const ImportCompletion& completion, State<Dim>& state) {
  if (const std::string fault = state.packing.law.fault_in_dimension(Dim); !fault.empty())
    throw InputError(completion.law_place, fault);
  if (imported.lacks_wall_contacts) find_wall_contacts(state.packing);
  if (!imported.contacts_known)
    find_missing_contacts(completion.touch_gap, state.packing);
  else if (!imported.liquid_known)
    spread_liquid(state.packing);
  refuse_impossible_density(place, state.packing);
  require_small_overlaps(place, state.packing);
  set_target_stress(imported, completion, state);
  state.tolerance = tolerance_for(imported, completion.tolerance);
  measure(state);
  state.provenance.program = "floc " + version();
  state.provenance.commit = commit();
  state.provenance.compiler = compiler();
  const std::string remark = stress_without_effect(completion, state.packing);
  if (!holds_liquid(state.packing)) return remark;
  if (imported.liquid_known) {
    Packing<Dim> shared = state.packing;
    state.n_bridges_unsettled = spread_liquid(shared).n_changed();
    return remark;
  }
  return remark + (remark.empty() ? "" : "; ") +
         "the file does not contain the volumes of the liquid bridges; the volumes and the forces are computed "
         "by the contact law";
}

template std::string complete_import(const std::string&, const Imported&, const ImportCompletion&, State<2>&);
template std::string complete_import(const std::string&, const Imported&, const ImportCompletion&, State<3>&);

}  // namespace floc
