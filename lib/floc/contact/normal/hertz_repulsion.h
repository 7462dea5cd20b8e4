#pragma once

#include <algorithm>
#include <cmath>

#include "floc/base/lanes.h"
#include "floc/contact/contact_load.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Repulsion of elastic spheres with the force FNe = (4/3) E* sqrt(R*) d^(3/2) at an overlap d. E* is given by
/// 1/E* = 2 (1 - nu^2)/E for two grains of one material, and R* is the reduced radius (docs/physics.md,
/// "Spheres of Hertz and Mindlin"). [AR2007], Eq. 1.
struct HertzRepulsion {
  double modulus;  ///< Young's modulus E (force/length^2)
  double poisson;  ///< Poisson's ratio nu, in (-1, 1/2)

  static constexpr const char* kKeyword = "hertz";
  static constexpr Family kFamily = Family::elastic_spheres;
  static constexpr int kDimension = 3;
  static constexpr bool kNeedsReducedRadius = true;
  static constexpr double kForceExponent = 1.5;
  static constexpr bool kIsForSmallOverlaps = true;
  static constexpr Number<HertzRepulsion> kNumbers[] = {
      {"modulus", &HertzRepulsion::modulus, Unit::pressure, "E", Requirement::positive,
       "a positive number (Young's modulus E, force per area)", "Young's modulus"},
      {"poisson", &HertzRepulsion::poisson, Unit::ratio, "nu", Requirement::poisson_ratio,
       "Poisson's ratio nu, in (-1, 0.5)", "Poisson's ratio"}};

  /// Returns the modulus (force/length^2) by which pressures are divided to make them dimensionless. The modulus is
  /// E/(1 - nu^2), with Young's modulus E and Poisson's ratio nu.
  double plane_modulus() const { return modulus / (1.0 - poisson * poisson); }

  template <class T>
  T force(const PairGeometry<T>& pair) const {
    return T(2.0 / 3.0) * contact_stiffness(pair) * overlap(pair);
  }
  template <class T>
  T stiffness(const PairGeometry<T>& pair) const {
    return contact_stiffness(pair);
  }
  /// Returns Mindlin's tangential stiffness K_T = K_N (2 - 2 nu)/(2 - nu) (force/length), with the normal stiffness K_N
  /// and Poisson's ratio nu.
  template <class T>
  T shear_stiffness(const PairGeometry<T>& pair) const {
    return T(shear_ratio()) * contact_stiffness(pair);
  }
  double shear_ratio() const { return (2.0 - 2.0 * poisson) / (2.0 - poisson); }

  /// Returns the overlap (length) at which the elastic normal force is `elastic` >= 0.
  double overlap_at_force(const PairGeometry<>& pair, double elastic) const {
    return std::pow(0.75 * elastic / (0.5 * plane_modulus() * std::sqrt(pair.reduced_radius)), 2.0 / 3.0);
  }
  /// Returns the largest overlap (length) in a collision of two free grains with the relative speed `speed`, under the
  /// assumption that all kinetic energy of their relative motion becomes elastic energy.
  double overlap_of_impact(const PairGeometry<>& pair, double speed) const {
    return std::pow(
        15.0 * pair.reduced_mass * speed * speed / (8.0 * plane_modulus() * std::sqrt(pair.reduced_radius)),
        0.4);
  }
  /// Returns the normal stiffness K_N (force/length) of a contact whose elastic force is `elastic`.
  double stiffness_at_force(const PairGeometry<>& pair, double elastic) const {
    return contact_stiffness(PairGeometry<>(-overlap_at_force(pair, elastic), pair.reduced_radius));
  }
  double modulus_of_packing(int, double) const { return plane_modulus(); }
  /// Returns an upper bound on the normal stiffness K_N (force/length) of a contact of this pair in a packing. The
  /// largest overlap, force and impact speed in the packing are given by `load`.
  double stiffness_bound(const PairGeometry<>& pair, const ContactLoad& load) const {
    const double deepest = std::max(
        {load.overlap, overlap_at_force(pair, load.force), overlap_of_impact(pair, load.impact_speed)});
    return contact_stiffness(PairGeometry<>(-deepest, pair.reduced_radius));
  }

  bool operator==(const HertzRepulsion&) const = default;

 private:
  template <class T>
  static T overlap(const PairGeometry<T>& pair) {
    return lanes::max(T(-pair.gap), T(0));
  }
  /// Returns the normal stiffness K_N = 2 E* sqrt(R* d) if the surfaces overlap by d, otherwise 0, with the symbols E*
  /// and R* of HertzRepulsion. The square root of zero is never computed, because the square root has no derivative at
  /// zero.
  template <class T>
  T contact_stiffness(const PairGeometry<T>& pair) const {
    using std::sqrt;
    const auto touches = pair.gap < T(0);
    const T root = sqrt(lanes::select(touches, T(pair.reduced_radius * -pair.gap), T(1)));
    return lanes::select(touches, T(T(plane_modulus()) * root), T(0));
  }
};

}  // namespace floc
