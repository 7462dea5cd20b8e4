#pragma once

#include <cmath>
#include <numbers>

#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Choice of the mass m in the damping coefficient of a contact, 2 zeta sqrt(m K_N), with the damping ratio zeta and
/// the normal stiffness K_N. Both masses are fixed multiples of the effective mass, so all pairs of grains have the
/// same restitution.
enum class DampingMass {
  effective,  ///< effective mass m_i m_j/(m_i + m_j); collisions have the given restitution [GRC2008]
  /// 2 m_i m_j/(m_i + m_j): for two equal grains, this is the mass of one grain. The damping ratio is sqrt(2) times the
  /// damping ratio with `effective` [SVI2024].
  grain,
};

/// Returns the fraction zeta of critical damping at which a collision on a linear spring has the restitution e, 0 < e
/// <= 1: zeta = -ln e / sqrt(pi^2 + ln^2 e).
inline double damping_ratio(double restitution) {
  const double l = std::log(restitution);
  return -l / std::sqrt(std::numbers::pi * std::numbers::pi + l * l);
}

/// Viscous normal force -c dh/dt while the surfaces overlap, where h is the gap. The damping coefficient is c = 2 zeta
/// sqrt(m K_N) with the damping ratio zeta (damping_ratio()), the mass m (DampingMass) and the normal stiffness K_N.
/// The force may be tensile: without its tensile part, the restitution would be different. The force is not part of the
/// static force.
struct ViscousDamping {
  double restitution;  ///< restitution e_N of a binary collision without adhesion, in (0, 1]
  DampingMass mass_rule = DampingMass::effective;

  static constexpr const char* kKeyword = "viscous";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kIsInEveryFile = true;
  static constexpr bool kIsDefault = true;
  static constexpr Number<ViscousDamping> kNumbers[] = {
      {"restitution", &ViscousDamping::restitution, Unit::ratio, "e_N", Requirement::at_most_one,
       "a restitution coefficient e_N in (0, 1]", "restitution coefficient"}};
  static constexpr const char* kMassRules[] = {"effective", "grain", nullptr};
  static constexpr Choice<ViscousDamping> kChoices[] = {{"mass", kMassRules,
                                                         chosen<ViscousDamping, &ViscousDamping::mass_rule>,
                                                         choose<ViscousDamping, &ViscousDamping::mass_rule>}};

  /// Returns the damping coefficient c (force * time/length) of a pair of grains.
  /// @param normal  a normal law of constant stiffness
  template <class Normal>
  double coefficient(const CollisionMass& mass, const Normal& normal) const {
    const double m = mass_rule == DampingMass::effective ? mass.effective : mass.grain;
    return 2.0 * damping_ratio(restitution) * std::sqrt(m * normal.normal_stiffness);
  }
  template <class T>
  T force(const T& coefficient, const NormalResponse<T>&, const T& gap_rate) const {
    return -coefficient * gap_rate;
  }

  bool operator==(const ViscousDamping&) const = default;
};

}  // namespace floc
