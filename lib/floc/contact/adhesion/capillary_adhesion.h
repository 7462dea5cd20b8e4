#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/base/lanes.h"
#include "floc/contact/declaration.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Decrease of the force of a liquid bridge with the gap.
enum class BridgeForm {
  exponential,  ///< exp(-h/l), l = 0.9 sqrt(V_b/(r R')) [RTV2010]
  rational,     ///< 1/(1 + 1.05 x + 2.5 x^2), x = h sqrt(R'/V_b) [WAJS2000]
};

/// Condition under which a liquid bridge forms.
enum class BridgeFormation {
  gap,      ///< as soon as the gap is within its reach
  contact,  ///< when the surfaces touch; it breaks when the gap is wider than its reach
};

/// Parameters of a liquid bridge between two grains; all zero without a bridge.
template <class T = double>
struct Bridge {
  T strength = T(0);  ///< Gamma R, the force when the surfaces touch (force)
  T decay = T(0);     ///< 1/l, or sqrt(R'/V_b) of the rational form (1/length)
  T reach = T(0);     ///< hm, the widest gap that the bridge spans (length)
};

/// Liquid bridges between spheres: a force -Gamma R in contact, which falls with the gap up to the reach of the
/// bridge. Gamma = 2 pi g cos th, R = sqrt(Ri Rj), reach (1 + th/2) V_b^(1/3). The history of a contact holds
/// the volume V_b of its bridge (length^3); how the liquid of a packing is shared between the bridges is not
/// part of the law (packing/liquid/liquid.h). In 2D disks stand for a layer of spheres.
struct CapillaryAdhesion {
  double surface_tension;  ///< g (force/length)
  double contact_angle;    ///< th (degrees)
  double water_content;    ///< w, mass of the liquid over that of the grains
  double density_ratio;    ///< density of the grains over that of the liquid
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
       "an angle in degrees, in [0, 90]", "contact angle of the liquid, degrees"},
      {"water_content", &CapillaryAdhesion::water_content, Unit::ratio, "w", Requirement::not_negative,
       "a number >= 0 (mass of the liquid over that of the grains)", "mass of liquid over mass of grains"},
      {"density_ratio", &CapillaryAdhesion::density_ratio, Unit::ratio, "rho_s/rho_l", Requirement::positive,
       "a positive number (density of the grains over that of the liquid)", "density of grains over liquid"}};
  static constexpr const char* kForms[] = {"exponential", "rational", nullptr};
  static constexpr const char* kFormations[] = {"gap", "contact", nullptr};
  static constexpr Choice<CapillaryAdhesion> kChoices[] = {
      {"form", kForms, chosen<CapillaryAdhesion, &CapillaryAdhesion::form>,
       choose<CapillaryAdhesion, &CapillaryAdhesion::form>},
      {"formation", kFormations, chosen<CapillaryAdhesion, &CapillaryAdhesion::formation>,
       choose<CapillaryAdhesion, &CapillaryAdhesion::formation>}};
  static constexpr History kHistory[] = {
      {"bridge_volume", HistoryKind::scalar, Unit::volume,
       "volume of the liquid bridge, 0 without one; negative where it has broken and its liquid is not yet "
       "shared out"}};

  /// Contact angle in radians.
  double angle() const { return contact_angle * std::numbers::pi / 180.0; }
  /// Gamma R of two grains, the force that pulls them apart (force). It does not depend on the volume.
  double strength(double radius_i, double radius_j) const {
    return 2.0 * std::numbers::pi * surface_tension * std::cos(angle()) * std::sqrt(radius_i * radius_j);
  }
  /// hm, the widest gap that a bridge of this volume (length^3) spans (length).
  double reach(double volume) const { return (1.0 + 0.5 * angle()) * std::cbrt(volume); }
  /// Volume of the liquid for grains of this volume (length^3).
  double liquid_volume(double solid_volume) const { return water_content * density_ratio * solid_volume; }
  /// Parameters of a bridge of this volume (length^3) between two grains.
  Bridge<> bridge(double radius_i, double radius_j, double volume) const {
    if (!(volume > 0.0)) return {};
    const double mean = 2.0 * reduced(radius_i, radius_j);
    if (form == BridgeForm::rational)
      return {strength(radius_i, radius_j), std::sqrt(mean / volume), reach(volume)};
    const double ratio = std::max(radius_i / radius_j, radius_j / radius_i);
    return {strength(radius_i, radius_j), std::sqrt(ratio * mean / volume) / kDecayLength, reach(volume)};
  }

  /// Updates the bridge of a pair by one motion: where formation is `contact`, it breaks if the gap is wider
  /// than its reach, and forms again if the surfaces touch.
  /// @param pair  geometry at the end of the motion
  /// @param volume  the history, updated
  /// @return parameters of the bridge as it acts now
  template <class T>
  Bridge<T> hold(const PairGeometry<T>& pair, const Bridge<T>& bridge, T* volume) const {
    if (formation == BridgeFormation::contact) {
      const T liquid = lanes::max(*volume, T(-*volume));
      const T still = lanes::select(bridge.reach < pair.gap, T(-liquid), *volume);
      *volume = lanes::select(pair.gap < T(0), liquid, still);
    }
    return acting(bridge, *volume);
  }
  /// Parameters of a bridge as it acts: its strength is zero where it has broken.
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
  /// -dF/dh: negative across the gap, where parting weakens the attraction.
  template <class T>
  T stiffness(const PairGeometry<T>& pair, const Bridge<T>& bridge) const {
    const T x = lanes::max(pair.gap, T(0)) * bridge.decay;
    const T share = share_at(x);
    const T slope =
        form == BridgeForm::exponential ? share : T((T(kLinear) + T(2.0 * kSquare) * x) * share * share);
    const T across = lanes::select(bridge.reach < pair.gap, T(0), T(-bridge.strength * bridge.decay * slope));
    return lanes::select(pair.gap < T(0), T(0), across);
  }
  /// Potential energy at a fixed volume, zero at and beyond the reach.
  template <class T>
  T energy(const PairGeometry<T>& pair, const Bridge<T>& bridge) const {
    if (!(T(0) < bridge.decay)) return T(0);
    const T h = lanes::max(pair.gap, T(0));
    const T across = -(bridge.strength / bridge.decay) *
                     (integral_to(T(bridge.reach * bridge.decay)) - integral_to(T(h * bridge.decay)));
    return lanes::select(bridge.reach < pair.gap, T(0),
                         T(across + bridge.strength * lanes::min(pair.gap, T(0))));
  }
  /// Zero: the reach of a bridge depends on its volume, so that the law has no range of its own.
  double range() const { return 0.0; }
  /// Whether bridges attract: there is liquid, and its surface tension pulls.
  bool acts() const { return surface_tension > 0.0 && water_content > 0.0 && contact_angle < 90.0; }

  bool operator==(const CapillaryAdhesion&) const = default;

 private:
  static constexpr double kDecayLength = 0.9;
  static constexpr double kLinear = 1.05, kSquare = 2.5;

  /// Force over the force in contact, at x = gap times decay.
  template <class T>
  T share_at(const T& x) const {
    if (form == BridgeForm::exponential) return lanes::exp_of_negative(T(-x));
    return T(1) / (T(1) + x * (T(kLinear) + T(kSquare) * x));
  }
  /// Integral of share_at() from 0 to x.
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
