#pragma once

namespace floc {

/// Reduced radius or mass of two grains: p q/(p + q).
inline double reduced(double p, double q) {
  return p * q / (p + q);
}

/// The masses of a collision that damping may refer to (viscous_damping.h).
struct CollisionMass {
  double effective;  ///< m_i m_j/(m_i + m_j)
  double grain;      ///< twice that, the mass of a grain among equals

  static CollisionMass between(double mass_i, double mass_j) {
    const double effective = reduced(mass_i, mass_j);
    return {effective, 2.0 * effective};
  }
  /// Against a wall, which no grain moves, both are the grain's own mass.
  static CollisionMass against_wall(double mass) { return {mass, mass}; }
};

/// What a law may need to know of two surfaces. Reduced radius and mass are there for laws that need them
/// (`kNeedsReducedRadius`, `kNeedsReducedMass` of a model), zero for others.
template <class T = double>
struct PairGeometry {
  T gap;             ///< h (length), negative when the grains overlap
  T reduced_radius;  ///< Ri Rj/(Ri + Rj) (length)
  T reduced_mass;    ///< mi mj/(mi + mj) (mass)

  PairGeometry() = default;
  /// Implicit: for most laws the gap is all there is.
  PairGeometry(const T& h, const T& radius = T(0), const T& mass = T(0))  // NOLINT(google-explicit-constructor)
      : gap(h), reduced_radius(radius), reduced_mass(mass) {}
};

}  // namespace floc
