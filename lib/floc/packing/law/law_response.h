#pragma once

#include "floc/contact/history_layout.h"
#include "floc/contact/law_table.h"
#include "floc/packing/law/contact_response.h"
#include "floc/packing/packing.h"

/// How one contact responds by a composed law: what all evaluations outside the force loop share.
namespace floc {

/// Relative distance below its cap at which a spring counts as being at it: it may be there by rounding alone.
inline constexpr double kCapTolerance = 1e-12;

/// What the law may need to know of the pair, at the contact's gap. A wall is flat and moves as if no grain
/// could stop it.
template <int Dim>
PairGeometry<> pair_geometry(const Grains<Dim>& grains, const Contact<Dim>& c) {
  if (c.j >= grains.size()) return {c.gap, grains.radius[c.i], grains.mass[c.i]};
  return {c.gap, reduced(grains.radius[c.i], grains.radius[c.j]), reduced(grains.mass[c.i], grains.mass[c.j])};
}

/// The parameters of the pair under the law; a grain on a wall is dry.
template <class Law, int Dim>
typename Law::template PairParameters<> pair_parameters(
    const Law& law, const Grains<Dim>& grains, const Contact<Dim>& c,
    const PackedHistory<Law::template kHistorySize<Dim>>& history) {
  if (c.j >= grains.size()) return {};
  return law.template pair_parameters<Dim>(grains.radius[c.i], grains.radius[c.j], history);
}
/// These parameters as they act at the contact now.
template <class Law, int Dim>
typename Law::template PairParameters<> acting_parameters(const Law& law, const Grains<Dim>& grains,
                                                          const Contact<Dim>& c) {
  const auto history = packed_history<Law, Dim>(c.history);
  return law.template acting<Dim>(pair_parameters(law, grains, c, history), history);
}

/// Whether the surfaces of a contact touch, at its gap and by what it remembers.
template <class Law, int Dim>
bool touches(const Law& law, const Grains<Dim>& grains, const Contact<Dim>& c) {
  return law.template touches<Dim>(pair_geometry(grains, c), packed_history<Law, Dim>(c.history));
}

/// Flags of the springs that are at their caps; none for a distant attraction.
template <class Law, int Dim>
void set_mobilised(const Law& law, const PackedHistory<Law::template kHistorySize<Dim>>& history,
                   double tolerance, Contact<Dim>& c) {
  Mobilised m;
  if (!c.distant) m = law.template mobilised<Dim>(c.elastic_force, history, tolerance);
  c.sliding = m.sliding;
  c.rolling_yield = m.rolling;
  c.twisting_yield = m.twisting;
}

/// Static forces, stiffnesses, flags and history of a contact whose surfaces have moved since its history was
/// updated; its gap and normal are those after the motion.
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
