#pragma once

namespace floc {

/// Returns F^2/K, twice the complementary energy of a spring of stiffness K that carries the force F: zero without a
/// force, even if the spring has no stiffness, and infinite if there is a force but no stiffness.
inline double compliance_term(double squared_force, double stiffness) {
  return squared_force == 0.0 ? 0.0 : squared_force / stiffness;
}

}  // namespace floc
