#pragma once

#include <string>

#include "floc/contact/law.h"

/// Soft springs, with which grains rearrange in fewer time steps (docs/numerics.md, "Soft collapse").
namespace floc {

/// Returns a contact law whose springs are softer by a factor s >= 1: normal, tangential, rolling and twisting
/// stiffness are divided by s, or Young's modulus of a Hertz contact. The adhesion, the friction coefficients and the
/// restitution stay.
Law softened(const Law& law, double s);

/// Largest factor by which springs may be softened, and why.
struct SofteningLimit {
  double largest;      ///< largest factor; at most 1 if no softening is possible
  std::string reason;  ///< consequence of a larger factor, in words

  /// Returns why springs cannot be softer by a factor s, in words that name the largest factor; empty if they can.
  std::string fault(double s) const;
};

/// Returns the largest factor by which the springs of a contact law may be softened: under the pull-off force F0, softer
/// springs must not overlap by more than a tenth of the range D0 of the adhesion, and the pressure must not exceed a
/// hundredth of their modulus (Law::contact_modulus()).
/// @param diameter  largest diameter of the grains (length)
/// @param pressure  largest pressure on the packing (force/length^(dim-1))
SofteningLimit softening_limit(const Law& law, int dim, double diameter, double pressure);

}  // namespace floc
