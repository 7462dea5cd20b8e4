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
#include "floc/contact/normal/rigid_contact.h"
#include "floc/contact/rolling/rolling_spring.h"
#include "floc/contact/tangential/coulomb_friction.h"
#include "floc/contact/tangential/mindlin_friction.h"
#include "floc/contact/tangential/rigid_friction.h"
#include "floc/contact/twisting/twisting_spring.h"

namespace floc {

/// Reason why a contact law cannot be used: its models cannot be combined, a model is made for another space dimension,
/// or two numbers of a model contradict each other.
struct LawFault {
  std::string slot;      ///< key of the slot at fault, such as "friction"
  std::string words;     ///< message with the wrong key (contact.SLOT...) and the requirement on its value
  std::string key = {};  ///< key of the number at fault; empty if the fault is not a single number
};

/// Contact law as a scene file or a saved state describes it. Each slot (normal, adhesion, ...) holds a model with its
/// numbers, or is empty. The types of the slots are the only lists of models in the program. All code that handles
/// models uses these lists: for scene files, for texts that describe laws, for state files, and in law_table.h, which
/// converts LawParameters into a composed type.
struct LawParameters {
  LawSlot<LinearRepulsion, HertzRepulsion, RigidContact> normal;
  LawSlot<NoAdhesion, TailAdhesion, ConstantAdhesion, CapillaryAdhesion> adhesion;
  LawSlot<NoDamping, ViscousDamping, CriticalDamping> damping;
  LawSlot<NoFriction, CoulombFriction, MindlinFriction, RigidFriction> friction;
  LawSlot<NoRolling, RollingSpring> rolling;
  LawSlot<NoTwisting, TwistingSpring> twisting;

  /// Calls visit(key, slot) for each slot, in the order below. The key is the name of the table that describes the slot
  /// in a scene file.
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

  /// Returns all faults of the law, each as "key = value: requirement"; empty if the law can be used.
  std::vector<std::string> validate() const;
  /// Returns one fault for each model that cannot be combined with the other models. The values of numbers do not
  /// matter for these faults.
  std::vector<LawFault> faults_between_slots() const;
  /// Returns one fault for each number that is valid by itself but contradicts another number of its model (AtLeast).
  std::vector<LawFault> faults_between_numbers() const;
  /// Returns one fault for each model that is made for another space dimension.
  std::vector<LawFault> faults_in_dimension(int dimension) const;
};

}  // namespace floc
