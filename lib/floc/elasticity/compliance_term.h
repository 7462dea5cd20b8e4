#pragma once

namespace floc {

/// Returns F^2/K, twice the complementary energy of a spring of stiffness K that carries the force F. The result is
/// zero if F = 0, even if K = 0; it is infinite if K = 0 and F is not zero.
inline double compliance_term(double squared_force, double stiffness) {
  return squared_force == 0.0 ? 0.0 : squared_force / stiffness;
}

}  // namespace floc
