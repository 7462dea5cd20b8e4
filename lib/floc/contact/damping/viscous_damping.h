#pragma once

#include <cmath>
#include <numbers>

namespace floc {

/// Which mass the critical damping of a contact is taken with.
enum class DampingMass {
  effective,  ///< m_i m_j/(m_i + m_j): the restitution holds for every pair (G08)
  grain,      ///< the mass of grain i: the restitution holds against a wall (B24)
};

/// Fraction of critical damping that gives a linear spring the restitution e, 0 < e <= 1:
/// zeta = -ln e / sqrt(pi^2 + ln^2 e).
inline double damping_ratio(double restitution) {
  const double l = std::log(restitution);
  return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

/// Viscous normal force -c dh/dt while the surfaces overlap, c = 2 zeta sqrt(m K_N). It may pull: cutting its tension
/// changes the restitution. It is no part of the static force.
struct ViscousDamping {
  double restitution;  ///< of a binary collision without adhesion, in (0, 1]
  DampingMass mass_rule = DampingMass::effective;

  /// Damping coefficient c of a pair (force * time/length).
  double coefficient(double mass_i, double mass_j, double normal_stiffness) const {
    const double m = mass_rule == DampingMass::effective ? mass_i * mass_j / (mass_i + mass_j) : mass_i;
    return 2.0 * damping_ratio(restitution) * std::sqrt(m * normal_stiffness);
  }
};

}  // namespace floc
