#pragma once

#include <array>
#include <string>
#include <vector>

#include "floc/contact/adhesion/capillary_adhesion.h"
#include "floc/contact/adhesion/constant_adhesion.h"
#include "floc/contact/adhesion/tail_adhesion.h"
#include "floc/contact/damping/critical_damping.h"
#include "floc/contact/damping/viscous_damping.h"
#include "floc/contact/law_slot.h"
#include "floc/contact/normal/hertz_repulsion.h"
#include "floc/contact/normal/linear_repulsion.h"
#include "floc/contact/rolling/rolling_spring.h"
#include "floc/contact/tangential/coulomb_friction.h"
#include "floc/contact/tangential/mindlin_friction.h"
#include "floc/contact/twisting/twisting_spring.h"

namespace floc {

/// Why the models of a law cannot be used together, or not in this dimension.
struct LawFault {
  std::string slot;   ///< that is to blame
  std::string words;  ///< "contact.SLOT...: requirement"
};

/// A contact law as a scene or a saved state names it: a model with its numbers in each slot, absent where
/// nothing is said. These are THE lists of models: what is listed here is known to scenes, law texts, state
/// files and the law table (law_table.h), which turns a LawParameters into the composed type.
struct LawParameters {
  LawSlot<LinearRepulsion, HertzRepulsion> normal;
  LawSlot<NoAdhesion, TailAdhesion, ConstantAdhesion, CapillaryAdhesion> adhesion;
  LawSlot<NoDamping, ViscousDamping, CriticalDamping> damping;
  LawSlot<NoFriction, CoulombFriction, MindlinFriction> friction;
  LawSlot<NoRolling, RollingSpring> rolling;
  LawSlot<NoTwisting, TwistingSpring> twisting;

  /// Calls visit(key, slot) for each slot, in this order. The key is that of its table in a scene.
  template <class Self, class Visit>
  static void for_each_slot(Self& law, Visit&& visit) {
    visit("normal", law.normal);
    visit("adhesion", law.adhesion);
    visit("damping", law.damping);
    visit("friction", law.friction);
    visit("rolling", law.rolling);
    visit("twisting", law.twisting);
  }

  bool operator==(const LawParameters&) const = default;

  /// F0 of laws with one value for all pairs; 0 without adhesion and for liquid bridges.
  double pull_off_force() const;
  /// F0 of two grains of this radius, 0 without adhesion.
  double pull_off_force(double radius) const;
  /// Whether anything attracts.
  bool adheres() const { return pull_off_force(1.0) > 0.0; }
  /// Largest gap at which the law acts; adhesion of zero force acts nowhere. 0 for liquid bridges, whose reach
  /// depends on their volumes (packing/liquid.h).
  double range() const;
  /// The adhesion of liquid bridges, null where there is none or it has no liquid.
  const CapillaryAdhesion* liquid() const;
  /// Modulus that a pressure is compared with where nothing adheres: K_N/a^(Dim-2) for linear contacts of
  /// grains of diameter a, E/(1 - nu^2) for Hertz contacts (force/length^(Dim-1)).
  double contact_modulus(int dim, double diameter) const;

  /// Power of the overlap that the elastic force grows with. 1: the stiffness of a contact is a constant.
  double force_exponent() const;
  /// Whether the normal law holds for overlaps that are small beside the grains alone.
  bool is_for_small_overlaps() const;

  /// Whether friction can carry any force.
  bool resists_sliding() const;
  /// Whether the tangential stiffness follows the load: what friction carries depends on the way there then, also
  /// where nothing slides.
  bool friction_follows_load() const;

  /// Every fault as "key = value: requirement"; empty when the law can be used.
  std::vector<std::string> validate() const;
  /// Faults of models that do not go together: those that remain when every number is right.
  std::vector<LawFault> faults_between_slots() const;
  /// Faults of models that are for another dimension.
  std::vector<LawFault> faults_in_dimension(int dimension) const;
};

}  // namespace floc
