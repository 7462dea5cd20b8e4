#pragma once

#include <limits>

#include "floc/contact/model_traits.h"

namespace floc {

/// Rigid contact: the surfaces may touch but not overlap (Signorini's condition), and the normal force is not a
/// function of the gap. Forces of rigid contacts follow from the balance of all grains (floc/rigid), and saved states
/// store them.
struct RigidContact {
  static constexpr const char* kKeyword = "rigid";
  static constexpr Family kFamily = Family::rigid;

  /// Returns the modulus (force/length^(Dim-1)) by which the pressures of a packing are divided to make them
  /// dimensionless. The modulus is infinite, because a rigid contact is the limit of infinite stiffness.
  double modulus_of_packing(int, double) const { return std::numeric_limits<double>::infinity(); }

  bool operator==(const RigidContact&) const = default;
};

}  // namespace floc
