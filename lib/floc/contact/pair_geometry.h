#pragma once

namespace floc {

/// Reduced radius or mass of two grains: p q/(p + q).
inline double reduced(double p, double q) {
  return p * q / (p + q);
}

/// Masses of a collision that a damping model may use (DampingMass, viscous_damping.h).
struct CollisionMass {
  double effective;  ///< m_i m_j/(m_i + m_j)
  double grain;      ///< twice the effective mass: the mass of one of two equal grains

  static CollisionMass between(double mass_i, double mass_j) {
    const double effective = reduced(mass_i, mass_j);
    return {effective, 2.0 * effective};
  }
  /// Against a wall, whose mass counts as infinite, both are set to the mass of the grain.
  static CollisionMass against_wall(double mass) { return {mass, mass}; }
};

/// Gap, size and mass of two surfaces, as the models of a law read them. Reduced radius and mass are set only
/// for laws that need them (`kNeedsReducedRadius`, `kNeedsReducedMass` of a model) and are zero for others.
template <class T = double>
struct PairGeometry {
  T gap;             ///< h (length), negative when the grains overlap
  T reduced_radius;  ///< Ri Rj/(Ri + Rj) (length)
  T reduced_mass;    ///< mi mj/(mi + mj) (mass)

  PairGeometry() = default;
  /// Implicit, since most laws depend on the gap alone.
  PairGeometry(const T& h, const T& radius = T(0), const T& mass = T(0))  // NOLINT(google-explicit-constructor)
      : gap(h), reduced_radius(radius), reduced_mass(mass) {}
};

}  // namespace floc
