#pragma once

namespace floc {

/// Returns twice the complementary energy F^2/K of one spring: zero if there is no force, even without stiffness, and
/// infinite if there is a force but no stiffness.
inline double compliance_term(double squared_force, double stiffness) {
  return squared_force == 0.0 ? 0.0 : squared_force / stiffness;
}

}  // namespace floc
