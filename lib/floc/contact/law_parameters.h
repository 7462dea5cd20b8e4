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

/// Fault of a law that cannot be used: its models cannot be combined, or not in this dimension, or two of its
/// numbers contradict each other.
struct LawFault {
  std::string slot;      ///< slot with the fault
  std::string words;     ///< "contact.SLOT...: requirement"
  std::string key = {};  ///< key of the number with the fault, if it is one number
};

/// Contact law as a scene or a saved state names it: a model with its numbers in each slot, or an empty slot.
/// These are the only lists of models: scenes, law texts, state files and the law table (law_table.h), which
/// turns a LawParameters into the composed type, all follow from them.
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

  /// Every fault as "key = value: requirement"; empty when the law can be used.
  std::vector<std::string> validate() const;
  /// Faults of models that cannot be combined, whatever their numbers.
  std::vector<LawFault> faults_between_slots() const;
  /// Faults of numbers that are valid by themselves but contradict another number (AtLeast).
  std::vector<LawFault> faults_between_numbers() const;
  /// Faults of models that are for another dimension.
  std::vector<LawFault> faults_in_dimension(int dimension) const;
};

}  // namespace floc
