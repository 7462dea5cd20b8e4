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

/// Reason why a contact law cannot be used: its models cannot be combined, a model is made for another
/// dimension, or two of its numbers contradict each other.
struct LawFault {
  std::string slot;      ///< key of the slot at fault, such as "friction"
  std::string words;     ///< message: "contact.SLOT...: requirement"
  std::string key = {};  ///< key of the number at fault; empty if the fault is not a single number
};

/// Contact law as a scene or a saved state describes it. Each slot (normal, adhesion, ...) holds a model with
/// its numbers, or is empty. The types of the slots are the only lists of models in the program. Scenes, texts
/// that describe laws, state files and the law table (law_table.h), which converts LawParameters into a
/// composed type, all follow from these lists.
struct LawParameters {
  LawSlot<LinearRepulsion, HertzRepulsion> normal;
  LawSlot<NoAdhesion, TailAdhesion, ConstantAdhesion, CapillaryAdhesion> adhesion;
  LawSlot<NoDamping, ViscousDamping, CriticalDamping> damping;
  LawSlot<NoFriction, CoulombFriction, MindlinFriction> friction;
  LawSlot<NoRolling, RollingSpring> rolling;
  LawSlot<NoTwisting, TwistingSpring> twisting;

  /// Calls visit(key, slot) for each slot, in the order below. The key is the name of the table in a scene that
  /// describes the slot.
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

  /// Returns every fault of the law as "key = value: requirement"; empty if the law can be used.
  std::vector<std::string> validate() const;
  /// Returns the faults of models that cannot be combined, independent of their numbers.
  std::vector<LawFault> faults_between_slots() const;
  /// Returns the faults of numbers that are valid by themselves but contradict another number (AtLeast).
  std::vector<LawFault> faults_between_numbers() const;
  /// Returns a fault for each model that is made for another dimension.
  std::vector<LawFault> faults_in_dimension(int dimension) const;
};

}  // namespace floc
