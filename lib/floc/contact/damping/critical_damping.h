#pragma once

#include <cmath>

#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Viscous normal force -2 zeta sqrt(m_eff K_N) dh/dt with the gap h and the effective mass m_eff of the two grains.
/// The force is a fixed fraction zeta of critical damping at the present normal stiffness K_N. Under Hertz' law, the
/// restitution of a collision is therefore independent of the speed of the collision; for zeta of 0.912871 or more,
/// colliding grains never separate. The viscous force may be tensile, and is not part of the static force.
struct CriticalDamping {
  double critical_fraction;  ///< fraction zeta of critical damping, in (0, 1]

  static constexpr const char* kKeyword = "critical";
  static constexpr Family kFamily = Family::elastic_spheres;
  static constexpr bool kFollowsNormalStiffness = true;
  static constexpr Number<CriticalDamping> kNumbers[] = {
      {"critical_fraction", &CriticalDamping::critical_fraction, Unit::ratio, "zeta", Requirement::at_most_one,
       "a fraction zeta of critical damping, in (0, 1]", "fraction of critical damping"}};

  /// Returns the damping coefficient of a pair of grains, divided by the square root of the normal stiffness. This
  /// ratio is 2 zeta sqrt(m_eff), with the fraction zeta of critical damping and the effective mass m_eff.
  template <class Normal>
  double coefficient(const CollisionMass& mass, const Normal&) const {
    return 2.0 * critical_fraction * std::sqrt(mass.effective);
  }
  template <class T>
  T force(const T& coefficient, const NormalResponse<T>& normal, const T& gap_rate) const {
    using std::sqrt;
    return -coefficient * sqrt(normal.stiffness) * gap_rate;
  }

  bool operator==(const CriticalDamping&) const = default;
};

}  // namespace floc
