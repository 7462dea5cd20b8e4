#pragma once

#include <string>

#include "floc/contact/law.h"

/// Soft contact springs, which let grains rearrange in fewer time steps (docs/numerics.md, "Soft collapse").
namespace floc {

/// Returns a contact law with springs that are softer by a factor s >= 1. The normal, tangential, rolling and twisting
/// stiffnesses, or Young's modulus of a Hertz contact, are divided by s. The adhesion, the friction coefficients and
/// the restitution do not change.
Law softened(const Law& law, double s);

/// Largest factor by which springs may be softened, and the reason for this limit.
struct SofteningLimit {
  double largest;      ///< largest factor; at most 1 if no softening is possible
  std::string reason;  ///< consequence of a larger factor, for messages

  /// Returns a message with the reason why springs cannot be softened by a factor s, and with the largest possible
  /// factor; empty if the springs can be softened by s.
  std::string fault(double s) const;
};

/// Returns the largest factor by which the springs of a contact law may be softened. Two conditions limit the factor.
/// The overlap of two grains with softened springs under the pull-off force F0 must not exceed a tenth of the range D0
/// of the adhesion. The pressure must not exceed a hundredth of the modulus of the softened contacts
/// (Law::contact_modulus()).
/// @param diameter  largest diameter of the grains (length)
/// @param pressure  largest pressure on the packing (force/length^(dim-1))
SofteningLimit softening_limit(const Law& law, int dim, double diameter, double pressure);

}  // namespace floc
