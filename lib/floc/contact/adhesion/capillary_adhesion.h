#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/base/lanes.h"
#include "floc/contact/declaration.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Formula for the force of a liquid bridge, which decreases with the gap between two grains. Each formula gives the
/// force divided by the force at zero gap.
enum class BridgeForm {
  /// exp(-h/l) with the gap h and the decay length l = 0.9 sqrt(V_b/(r R')). V_b is the volume of the bridge, R' = 2 Ri
  /// Rj/(Ri + Rj) the harmonic mean of the radii Ri and Rj of the grains, and r >= 1 the ratio of these radii
  /// [RTV2010].
  exponential,
  /// 1/(1 + 1.05 x + 2.5 x^2) with x = h sqrt(R'/V_b). Here h is the gap, V_b the volume of the bridge, and R' = 2 Ri
  /// Rj/(Ri + Rj) the harmonic mean of the radii Ri and Rj of the grains [WAJS2000].
  rational,
};

/// Condition under which a liquid bridge forms between two grains.
enum class BridgeFormation {
  gap,  ///< a bridge forms as soon as the gap is within the reach of the bridge
  /// A bridge forms when the surfaces touch, and breaks when the gap exceeds the reach of the bridge.
  contact,
};

/// Parameters of a liquid bridge between two grains; all are zero if there is no bridge.
template <class T = double>
struct Bridge {
  T strength = T(0);  ///< attraction of the bridge when the surfaces touch (force)
  /// Factor that multiplies the gap in the formula for the force (1/length): 1/l for the exponential and sqrt(R'/V_b)
  /// for the rational formula, with the symbols of BridgeForm.
  T decay = T(0);
  T reach = T(0);  ///< widest gap hm that the bridge spans (length)
};

/// Liquid bridges between spheres. In contact the attraction is Gamma R; it decreases with the gap and is zero beyond
/// the reach of the bridge. Here Gamma = 2 pi g cos th with the surface tension g and the contact angle th, and R =
/// sqrt(Ri Rj) with the radii Ri and Rj of the spheres. The reach of a bridge of volume V_b is (1 + th/2) V_b^(1/3),
/// with th in radians. The history of a contact contains the volume of the bridge (length^3). Another module
/// distributes the liquid among the bridges of a packing (packing/liquid/liquid.h). In 2D, the disks represent a layer
/// of spheres.
struct CapillaryAdhesion {
  double surface_tension;  ///< surface tension g of the liquid (force/length)
  double contact_angle;    ///< contact angle th of the liquid on the grains (degrees)
  double water_content;    ///< water content w: mass of the liquid divided by the mass of the grains
  double density_ratio;    ///< density of the grains divided by the density of the liquid
  BridgeForm form = BridgeForm::exponential;
  BridgeFormation formation = BridgeFormation::gap;

  template <class T>
  using PairParameters = Bridge<T>;

  static constexpr const char* kKeyword = "capillary";
  static constexpr bool kHoldsLiquid = true;
  static constexpr bool kRollsFreely = true;
  static constexpr Number<CapillaryAdhesion> kNumbers[] = {
      {"surface_tension", &CapillaryAdhesion::surface_tension, Unit::stiffness, "gamma", Requirement::positive,
       "a positive number (surface tension, force per length)", "surface tension"},
      {"contact_angle", &CapillaryAdhesion::contact_angle, Unit::degrees, "theta", Requirement::acute_angle,
       "an angle in degrees, in [0, 90]", "contact angle of the liquid (degrees)"},
      {"water_content", &CapillaryAdhesion::water_content, Unit::ratio, "w", Requirement::not_negative,
       "a number >= 0 (mass of the liquid divided by the mass of the grains)",
       "mass of the liquid divided by the mass of the grains"},
      {"density_ratio", &CapillaryAdhesion::density_ratio, Unit::ratio, "rho_s/rho_l", Requirement::positive,
       "a positive number (density of the grains divided by the density of the liquid)",
       "density of the grains divided by the density of the liquid"}};
  static constexpr const char* kForms[] = {"exponential", "rational", nullptr};
  static constexpr const char* kFormations[] = {"gap", "contact", nullptr};
  static constexpr Choice<CapillaryAdhesion> kChoices[] = {
      {"form", kForms, chosen<CapillaryAdhesion, &CapillaryAdhesion::form>,
       choose<CapillaryAdhesion, &CapillaryAdhesion::form>},
      {"formation", kFormations, chosen<CapillaryAdhesion, &CapillaryAdhesion::formation>,
       choose<CapillaryAdhesion, &CapillaryAdhesion::formation>}};
  static constexpr History kHistory[] = {
      {"bridge_volume", HistoryKind::scalar, Unit::volume,
       "volume of the liquid bridge of the contact; 0 without a bridge, negative if the bridge has broken and "
       "its liquid has not been distributed to other bridges yet"}};

  /// Contact angle in radians.
  double angle() const { return contact_angle * std::numbers::pi / 180.0; }
  /// Returns the attraction (force) of a liquid bridge between two touching grains: 2 pi g cos th sqrt(Ri Rj) with the
  /// surface tension g, the contact angle th and the radii Ri and Rj. The attraction does not depend on the volume of
  /// the bridge.
  double strength(double radius_i, double radius_j) const {
    return 2.0 * std::numbers::pi * surface_tension * std::cos(angle()) * std::sqrt(radius_i * radius_j);
  }
  /// Returns the widest gap hm (length) that a bridge of this volume (length^3) spans.
  double reach(double volume) const { return (1.0 + 0.5 * angle()) * std::cbrt(volume); }
  /// Returns the total volume of liquid (length^3) in a packing; `solid_volume` is the total volume of its grains
  /// (length^3).
  double liquid_volume(double solid_volume) const { return water_content * density_ratio * solid_volume; }
  /// Returns the parameters of a liquid bridge of this volume (length^3) between two grains of these radii (length).
  Bridge<> bridge(double radius_i, double radius_j, double volume) const {
    if (!(volume > 0.0)) return {};
    const double mean = 2.0 * reduced(radius_i, radius_j);
    if (form == BridgeForm::rational)
      return {strength(radius_i, radius_j), std::sqrt(mean / volume), reach(volume)};
    const double ratio = std::max(radius_i / radius_j, radius_j / radius_i);
    return {strength(radius_i, radius_j), std::sqrt(ratio * mean / volume) / kDecayLength, reach(volume)};
  }

  /// Updates the liquid bridge between two grains after the motion of one step. If `formation` is `contact`, the bridge
  /// breaks when the gap exceeds its reach, and forms again when the surfaces overlap.
  /// @param pair  geometry of the two grains at the end of the step
  /// @param volume  volume of the bridge (length^3) in the history of the contact, updated; negative if the bridge has
  /// broken
  /// @return parameters of the bridge that are in effect after the step
  template <class T>
  Bridge<T> hold(const PairGeometry<T>& pair, const Bridge<T>& bridge, T* volume) const {
    if (formation == BridgeFormation::contact) {
      const T liquid = lanes::max(*volume, T(-*volume));
      const T still = lanes::select(bridge.reach < pair.gap, T(-liquid), *volume);
      *volume = lanes::select(pair.gap < T(0), liquid, still);
    }
    return acting(bridge, *volume);
  }
  /// Returns the parameters of a liquid bridge that are in effect now. They equal `bridge`, except that the strength is
  /// zero if the bridge has broken (`volume` <= 0).
  template <class T>
  Bridge<T> acting(Bridge<T> bridge, const T& volume) const {
    bridge.strength = lanes::select(T(0) < volume, bridge.strength, T(0));
    return bridge;
  }

  template <class T>
  T force(const PairGeometry<T>& pair, const Bridge<T>& bridge) const {
    const T share = share_at(lanes::max(pair.gap, T(0)) * bridge.decay);
    return lanes::select(bridge.reach < pair.gap, T(0), T(-bridge.strength * share));
  }
  /// Returns the stiffness -dF/dh (force/length) of the adhesive normal force F <= 0 at the gap h. The stiffness is
  /// negative across a gap, because the attraction weakens as the grains part.
  template <class T>
  T stiffness(const PairGeometry<T>& pair, const Bridge<T>& bridge) const {
    const T x = lanes::max(pair.gap, T(0)) * bridge.decay;
    const T share = share_at(x);
    const T slope =
        form == BridgeForm::exponential ? share : T((T(kLinear) + T(2.0 * kSquare) * x) * share * share);
    const T across = lanes::select(bridge.reach < pair.gap, T(0), T(-bridge.strength * bridge.decay * slope));
    return lanes::select(pair.gap < T(0), T(0), across);
  }
  /// Returns the potential energy of a liquid bridge of fixed volume. The energy is zero if the gap is at least the
  /// reach of the bridge.
  template <class T>
  T energy(const PairGeometry<T>& pair, const Bridge<T>& bridge) const {
    if (!(T(0) < bridge.decay)) return T(0);
    const T h = lanes::max(pair.gap, T(0));
    const T across = -(bridge.strength / bridge.decay) *
                     (integral_to(T(bridge.reach * bridge.decay)) - integral_to(T(h * bridge.decay)));
    return lanes::select(bridge.reach < pair.gap, T(0),
                         T(across + bridge.strength * lanes::min(pair.gap, T(0))));
  }
  /// Returns zero, because liquid bridges have no common range: the reach of each bridge depends on its volume.
  double range() const { return 0.0; }
  /// Returns whether liquid bridges can attract grains: there is liquid, its surface tension is positive and its
  /// contact angle is below 90 degrees.
  bool acts() const { return surface_tension > 0.0 && water_content > 0.0 && contact_angle < 90.0; }

  bool operator==(const CapillaryAdhesion&) const = default;

 private:
  static constexpr double kDecayLength = 0.9;
  static constexpr double kLinear = 1.05, kSquare = 2.5;

  /// Returns the force of a liquid bridge, divided by its force at zero gap, as a function of x, the gap times
  /// Bridge::decay.
  template <class T>
  T share_at(const T& x) const {
    if (form == BridgeForm::exponential) return lanes::exp_of_negative(T(-x));
    return T(1) / (T(1) + x * (T(kLinear) + T(kSquare) * x));
  }
  /// Returns the integral of share_at() from 0 to `x`.
  template <class T>
  T integral_to(const T& x) const {
    if (form == BridgeForm::exponential) return T(1) - lanes::exp_of_negative(T(-x));
    using std::atan;
    const double root = std::sqrt(4.0 * kSquare - kLinear * kLinear);
    return T(2.0 / root) *
           (atan(T((T(2.0 * kSquare) * x + T(kLinear)) * T(1.0 / root))) - T(std::atan(kLinear / root)));
  }
};

}  // namespace floc
