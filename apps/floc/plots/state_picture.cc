#include "plots/state_picture.h"

#include <fmt/format.h>

#include "floc/base/error.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/equilibrium.h"
#include "floc/picture/change_picture.h"
#include "floc/picture/drawn_scale.h"
#include "floc/picture/force_picture.h"
#include "floc/picture/pressure_picture.h"
#include "floc/structure/coordination.h"
#include "plots/pressure_text.h"

namespace floc {
namespace {

template <int Dim>
PackingPicture<Dim> increments_of(const std::string& file, const State<Dim>& state, StressStep step) {
  ModuliOptions options;
  options.unloaded = state.target_stress.isZero(0.0);
  const ContactNetwork<Dim> network = options.loaded_network(state.packing);
  const Moduli moduli = elastic_moduli(state.packing, options);
  const auto response = step_response(network, moduli.response, step);
  if (!response)
    throw InputError(file,
                     "a mechanism of this packing lets the cell deform without resistance, so that contact "
                     "forces cannot balance a step of stress: --forces increment expects a packing without "
                     "such mechanisms; floc modes lists them");
  return increment_forces(state.packing, network, *response);
}

/// Returns the largest normal force that counts as zero in the coordination numbers of path.csv.
template <int Dim>
double zero_force_of(const State<Dim>& state) {
  return state.tolerance.force * force_scale(state.packing, state.target_stress).force;
}

}  // namespace

template <int Dim>
PackingPicture<Dim> picture_of(const std::string& file, const State<Dim>& state, Shown shown) {
  PackingPicture<Dim> picture;
  switch (shown) {
    case Shown::equilibrium:
      picture = equilibrium_forces(state.packing, zero_force_of(state));
      break;
    case Shown::isotropic_step:
      picture = increments_of(file, state, StressStep::isotropic);
      break;
    case Shown::deviatoric_step:
      picture = increments_of(file, state, StressStep::deviatoric);
      break;
    case Shown::particle_pressure:
      picture = grain_pressures(state.packing, state.target_stress.mean());
      break;
    case Shown::phases:
      picture = pressure_phases_of(state.packing, zero_force_of(state));
      break;
    case Shown::kinds:
      picture = contact_kinds_of(state.packing, zero_force_of(state));
      break;
    case Shown::grains:
      picture = grains_of(state.packing);
      break;
  }
  // The coordination number z = 2 n_contacts/N (n_contacts: number of contacts between grains that touch, N: number of
  // grains) also counts contacts without a force. The second argument of coordination() does not change z.
  picture.caption = {pressure_text(state), fmt::format("Φ = {:.4f}", solid_fraction(state.packing)),
                     fmt::format("z = {:.2f}", coordination(state.packing, 0.0).z)};
  return picture;
}

template <int Dim>
PackingPicture<Dim> picture_of_changes(const std::string& before_file, const State<Dim>& before,
                                       const std::string& after_file, const State<Dim>& after) {
  if (const std::string reason = incomparable(before.packing, after.packing); !reason.empty())
    throw InputError(after_file, "this state cannot be compared with " + before_file + ": " + reason);
  const ContactChanges<Dim> changes = contact_changes(before.packing, after.packing);
  PackingPicture<Dim> picture = contacts_changed(before.packing, after.packing, changes);
  picture.caption = {
      fmt::format("P* = {} → {}", pressure_value(before), pressure_value(after)),
      fmt::format("Φ = {:.4f} → {:.4f}", solid_fraction(before.packing), solid_fraction(after.packing)),
      fmt::format("contacts: {} kept, {} lost, {} gained", changes.kept.size(), changes.lost.size(),
                  changes.gained.size())};
  return picture;
}

template PackingPicture<2> picture_of(const std::string&, const State<2>&, Shown);
template PackingPicture<3> picture_of(const std::string&, const State<3>&, Shown);
template PackingPicture<2> picture_of_changes(const std::string&, const State<2>&, const std::string&,
                                              const State<2>&);
template PackingPicture<3> picture_of_changes(const std::string&, const State<3>&, const std::string&,
                                              const State<3>&);

}  // namespace floc
