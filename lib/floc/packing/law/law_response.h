#pragma once

#include "floc/contact/history_layout.h"
#include "floc/contact/law_table.h"
#include "floc/packing/law/contact_response.h"
#include "floc/packing/packing.h"

/// Functions that evaluate a contact law for one contact. All code except the force loop of the dynamics uses these
/// functions.
namespace floc {

/// The force of a spring counts as being at its cap if it differs from the cap by at most this fraction of the cap. The
/// fraction allows for rounding errors.
inline constexpr double kCapTolerance = 1e-12;

/// Returns the gap, reduced radius and reduced mass of the two grains of a contact. A wall is flat and infinitely
/// heavy; the reduced radius and mass of a contact with a wall are therefore the radius and the mass of the grain.
template <int Dim>
PairGeometry<> pair_geometry(const Grains<Dim>& grains, const Contact<Dim>& c) {
  if (c.j >= grains.size()) return {c.gap, grains.radius[c.i], grains.mass[c.i]};
  return {c.gap, reduced(grains.radius[c.i], grains.radius[c.j]), reduced(grains.mass[c.i], grains.mass[c.j])};
}

/// Returns the parameters of a contact law that depend on the two grains of a contact, for example those of a liquid
/// bridge. A contact with a wall has no liquid bridge.
template <class Law, int Dim>
typename Law::template PairParameters<> pair_parameters(
    const Law& law, const Grains<Dim>& grains, const Contact<Dim>& c,
    const PackedHistory<Law::template kHistorySize<Dim>>& history) {
  if (c.j >= grains.size()) return {};
  return law.template pair_parameters<Dim>(grains.radius[c.i], grains.radius[c.j], history);
}
/// Returns the parameters that are in effect at the present history of a contact: those of pair_parameters(), except
/// that a broken liquid bridge has zero strength.
template <class Law, int Dim>
typename Law::template PairParameters<> acting_parameters(const Law& law, const Grains<Dim>& grains,
                                                          const Contact<Dim>& c) {
  const auto history = packed_history<Law, Dim>(c.history);
  return law.template acting<Dim>(pair_parameters(law, grains, c, history), history);
}

/// Returns whether the surfaces of a contact touch, at the present gap and history of the contact.
template <class Law, int Dim>
bool touches(const Law& law, const Grains<Dim>& grains, const Contact<Dim>& c) {
  return law.template touches<Dim>(pair_geometry(grains, c), packed_history<Law, Dim>(c.history));
}

/// Sets the flags of a contact (sliding, rolling_yield, twisting_yield), each of which tells whether the force of a
/// spring is at its cap. All flags are false if the surfaces attract each other across a gap.
template <class Law, int Dim>
void set_mobilised(const Law& law, const PackedHistory<Law::template kHistorySize<Dim>>& history,
                   double tolerance, Contact<Dim>& c) {
  Mobilised m;
  if (!c.distant) m = law.template mobilised<Dim>(c.elastic_force, history, tolerance);
  c.sliding = m.sliding;
  c.rolling_yield = m.rolling;
  c.twisting_yield = m.twisting;
}

/// Updates the static forces, stiffnesses, flags and history of a contact by the motion `surface` of its surfaces.
/// Before the call, the gap and the normal of the contact must be set to those after the motion.
template <class Law, int Dim>
void respond_to_motion(const Law& law, const Grains<Dim>& grains, const SurfaceMotion<Dim>& surface,
                       Contact<Dim>& c) {
  auto history = packed_history<Law, Dim>(c.history);
  const ContactMotion<Dim> motion{pair_geometry(grains, c),  0.0,          0.0, surface.slip,
                                  surface.relative_rotation, surface.twist};
  const auto parameters = pair_parameters(law, grains, c, history);
  const ContactForces<Dim> f = law.respond(motion, history, parameters);
  c.normal_force = f.normal.force();
  c.elastic_force = f.normal.elastic;
  c.shear_force = from_shear<double>(c.normal, f.shear);
  c.rolling_moment = -f.rolling;
  c.twisting_moment = -f.twisting;
  const ContactStiffness k = law.template stiffness<Dim>(motion.pair, history, parameters);
  c.kn = k.normal;
  c.kt = k.tangential;
  c.kr = k.rolling;
  c.ktw = k.twisting;
  c.distant = !f.normal.touches;
  set_mobilised(law, history, kCapTolerance, c);
  c.history = unpacked_history<Law, Dim>(history);
}

}  // namespace floc
