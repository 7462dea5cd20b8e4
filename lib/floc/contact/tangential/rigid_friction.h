#pragma once

#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"

namespace floc {

/// Coulomb friction of rigid contacts: the tangential force is at most the friction coefficient mu times the normal
/// force. Below this limit, the surfaces do not slip at all; the model has no stiffness.
struct RigidFriction {
  double coefficient;  ///< friction coefficient mu

  static constexpr const char* kKeyword = "rigid";
  static constexpr Family kFamily = Family::rigid;
  static constexpr bool kIsDefaultOfFamily = true;
  static constexpr Number<RigidFriction> kNumbers[] = {
      {"coefficient", &RigidFriction::coefficient, Unit::ratio, "mu", Requirement::not_negative,
       "a number >= 0 (friction coefficient mu)", "friction coefficient"}};

  /// Returns whether the friction force can differ from zero.
  bool acts() const { return coefficient != 0.0; }

  bool operator==(const RigidFriction&) const = default;
};

}  // namespace floc
