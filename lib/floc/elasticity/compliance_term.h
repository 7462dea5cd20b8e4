#pragma once

namespace floc {

/// Returns twice the complementary energy of one spring: zero without a force, whether the spring has a
/// stiffness or not; infinite with a force and no stiffness.
inline double compliance_term(double squared_force, double stiffness) {
  return squared_force == 0.0 ? 0.0 : squared_force / stiffness;
}

}  // namespace floc
