#pragma once

namespace floc {

/// Returns the reduced radius or reduced mass of two grains: p q/(p + q), where p and q are the radii or the masses of
/// the grains.
inline double reduced(double p, double q) {
  return p * q / (p + q);
}

/// Masses that a damping model may use for two colliding grains (DampingMass, viscous_damping.h).
struct CollisionMass {
  double effective;  ///< effective mass m_i m_j/(m_i + m_j)
  double grain;      ///< twice the effective mass; for two equal grains, this is the mass of one grain

  static CollisionMass between(double mass_i, double mass_j) {
    const double effective = reduced(mass_i, mass_j);
    return {effective, 2.0 * effective};
  }
  /// Returns the masses for a collision of a grain with a wall. The mass of the wall is infinite, so both members are
  /// the mass of the grain.
  static CollisionMass against_wall(double mass) { return {mass, mass}; }
};

/// Gap, reduced radius and reduced mass of a pair of grains, for the models of a contact law. The reduced radius and
/// the reduced mass are zero unless a model of the law needs them (`kNeedsReducedRadius`, `kNeedsReducedMass`).
template <class T = double>
struct PairGeometry {
  T gap;             ///< gap h between the surfaces (length), negative when the grains overlap
  T reduced_radius;  ///< reduced radius Ri Rj/(Ri + Rj) (length)
  T reduced_mass;    ///< reduced mass mi mj/(mi + mj) (mass)

  PairGeometry() = default;
  /// This constructor is implicit, so that a gap can be passed as the geometry of a pair: most contact laws depend on
  /// the gap alone.
  PairGeometry(const T& h, const T& radius = T(0), const T& mass = T(0))  // NOLINT(google-explicit-constructor)
      : gap(h), reduced_radius(radius), reduced_mass(mass) {}
};

}  // namespace floc
