#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "floc/base/lanes.h"
#include "floc/base/vec.h"
#include "floc/contact/absent.h"
#include "floc/contact/contact_history.h"
#include "floc/contact/contact_load.h"
#include "floc/contact/mobilised.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/pair_geometry.h"
#include "floc/geometry/frame.h"

namespace floc {

/// Relative motion of the surfaces of the grains i and j of a contact.
template <int Dim, class T = double>
struct ContactMotion {
  PairGeometry<T> pair;  ///< geometry of the pair after the motion
  T gap_rate;            ///< rate of change dh/dt of the gap (length/time)
  T damping;             ///< damping coefficient of the pair, from ContactLaw::damping_coefficient()
  /// Tangential displacement (length) of grain j relative to grain i since the last update of the history of the
  /// contact.
  Shear<Dim, T> slip;
  /// Rotation (radians) of grain i relative to grain j since the last update of the history of the contact. For
  /// spheres, it does not include the rotation about the normal, which is `twist`.
  RotationVector<Dim, T> relative_rotation;
  /// For spheres, rotation (radians) of grain i relative to grain j about the normal since the last update of the
  /// history of the contact.
  T twist = T(0);
};

/// Forces and moments that a contact exerts on its grains i and j. With the unit normal n from i to j, the force on j
/// is (normal.force() + viscous) n - shear, where `shear` lies in the tangent plane; the force on i is opposite.
/// Besides the moments of these forces, the contact exerts the moments `rolling` and `twisting` n on j, and the
/// opposite moments on i.
template <int Dim, class T = double>
struct ContactForces {
  NormalResponse<T> normal;  ///< static normal force, its elastic and adhesive parts and its stiffnesses
  /// Viscous normal force of the dashpot (force), positive if it pushes the grains apart; not part of the static force.
  T viscous;
  Shear<Dim, T> shear;             ///< tangential force on grain i, in the frame of the contact (force)
  RotationVector<Dim, T> rolling;  ///< rolling moment on grain j (force * length)
  T twisting = T(0);               ///< for spheres, twisting moment on grain j about n (force * length)
};

/// Stiffnesses of one contact in the elastic network of contacts, in which every contact is a set of springs.
struct ContactStiffness {
  /// Normal stiffness K_N (force/length) for small reversible motions. For surfaces that attract each other across a
  /// gap, with pull-off force F0 and range D0 of the adhesion, the stiffness is -F0/D0.
  double normal;
  double tangential;      ///< tangential stiffness K_T (force/length), 0 when the surfaces do not touch
  double rolling;         ///< rolling stiffness K_R (force * length), 0 when the surfaces do not touch
  double twisting = 0.0;  ///< twisting stiffness K_tw (force * length), 0 when the surfaces do not touch
};

/// Empty struct that replaces the parameters of a pair of grains in contact laws that need only the geometry of the
/// pair.
struct NoPairParameters {};

namespace detail {
template <class Adhesion, class T>
struct PairParametersOf {
  using Type = NoPairParameters;
};
template <class Adhesion, class T>
requires(requires { typename Adhesion::template PairParameters<T>; }) struct PairParametersOf<Adhesion, T> {
  using Type = typename Adhesion::template PairParameters<T>;
};
}  // namespace detail

/// Contact law composed of one model per slot: normal repulsion, adhesion, damping, friction, rolling and twisting
/// resistance. An empty slot (contact/absent.h) adds no data, no branch and no history. Every function that the
/// dynamics calls is a template on its number type and does not branch on values, so that one call can evaluate a SIMD
/// vector of contacts.
template <class Normal, class Adhesion, class Damping, class Tangential, class Rolling, class Twisting>
struct ContactLaw {
  static constexpr bool kHasAdhesion = !kIsAbsent<Adhesion>;
  static constexpr bool kHasDamping = !kIsAbsent<Damping>;
  static constexpr bool kHasFriction = !kIsAbsent<Tangential>;
  static constexpr bool kHasRolling = !kIsAbsent<Rolling>;
  static constexpr bool kHasTwisting = !kIsAbsent<Twisting>;
  static constexpr bool kHoldsLiquid = floc::kHoldsLiquid<Adhesion>;
  /// Whether the coefficient that damping_coefficient() returns has to be multiplied by the square root of the normal
  /// stiffness.
  static constexpr bool kDampingFollowsStiffness = kFollowsNormalStiffness<Damping>;
  /// Space dimension (2 or 3) for which the law is made; 0 if the law is valid in both.
  static constexpr int kDimension =
      std::max({kDimensionOf<Normal>, kDimensionOf<Tangential>, kDimensionOf<Twisting>});

  /// Whether the law depends on the reduced radius of a pair of grains. Only for such a law does the dynamics load the
  /// reduced radius.
  static constexpr bool kNeedsReducedRadius = requires { requires Normal::kNeedsReducedRadius; }
  || requires { requires Adhesion::kNeedsReducedRadius; };
  /// Whether the law depends on the reduced mass of a pair of grains.
  static constexpr bool kNeedsReducedMass = requires { requires Normal::kNeedsReducedMass; }
  || requires { requires Adhesion::kNeedsReducedMass; };

  /// Parameters of a pair of grains, for example of its liquid bridge. Most laws have none. The function
  /// pair_parameters() computes them once from the radii of the grains and the history of the contact, so that they
  /// need not be computed at every evaluation of the force.
  template <class T = double>
  using PairParameters = typename detail::PairParametersOf<Adhesion, T>::Type;

  /// Number of values in the history of a contact: the values of the normal, tangential, rolling, twisting and adhesion
  /// models, in this order.
  template <int Dim>
  static constexpr int kHistorySize =
      history_size<Normal>(Dim) + history_size<Tangential>(Dim) + history_size<Rolling>(Dim) +
      history_size<Twisting>(Dim) + history_size<Adhesion>(Dim);

  using NormalModel = Normal;
  using AdhesionModel = Adhesion;
  using TangentialModel = Tangential;
  using RollingModel = Rolling;
  using TwistingModel = Twisting;

  [[no_unique_address]] Normal repulsion;
  [[no_unique_address]] Adhesion adhesion;
  [[no_unique_address]] Damping damping;
  [[no_unique_address]] Tangential friction;
  [[no_unique_address]] Rolling rolling;
  [[no_unique_address]] Twisting twisting;

  /// Returns the largest gap (length) at which surfaces that have not touched before attract each other.
  double range() const {
    if constexpr (kHasAdhesion) return adhesion.range();
    return 0.0;
  }
  /// Returns the largest gap (length) at which surfaces that have touched before may still stick together. The result
  /// is zero unless the normal law lets surfaces stick together across a gap.
  double holding_range([[maybe_unused]] double reduced_radius) const {
    if constexpr (requires { repulsion.holding_range(reduced_radius); })
      return repulsion.holding_range(reduced_radius);
    return 0.0;
  }

  /// Returns whether a pair with this history belongs to the list of contacts. It does if its surfaces touch, overlap
  /// or attract each other across the gap, or if it has a liquid bridge, even a broken one.
  template <int Dim>
  bool interacts(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kHoldsLiquid)
      if (history.value[kAdhesionBegin<Dim>] != 0.0) return true;
    return pair.gap < 0.0 || pair.gap < range() || touches<Dim>(pair, history);
  }

  /// Returns the parameters of a pair of grains with these radii (length) and this history: the parameters of the
  /// liquid bridge, or no parameters if the law has no liquid.
  template <int Dim>
  PairParameters<> pair_parameters([[maybe_unused]] double radius_i, [[maybe_unused]] double radius_j,
                                   [[maybe_unused]] const PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kHoldsLiquid)
      return adhesion.bridge(radius_i, radius_j, std::abs(history.value[kAdhesionBegin<Dim>]));
    else
      return {};
  }
  /// Returns the present parameters of a pair of grains: `parameters`, but with zero strength if the history of the
  /// pair says that the liquid bridge has broken.
  /// @pre the grains have not moved since the last update of the history
  template <int Dim>
  PairParameters<> acting(const PairParameters<>& parameters,
                          [[maybe_unused]] const PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kHoldsLiquid)
      return adhesion.acting(parameters, history.value[kAdhesionBegin<Dim>]);
    else
      return parameters;
  }

  /// Returns whether the surfaces of a contact touch (NormalResponse::touches).
  template <int Dim>
  bool touches(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history) const {
    return in_touch(pair, normal_history(history));
  }

  /// Returns the static normal force of a pair of grains, its elastic and adhesive parts and its stiffnesses.
  /// @param history  history of the normal model of the law; null for a new contact
  /// @param parameters  parameters of the pair that are in effect now, see acting()
  template <class T>
  NormalResponse<T> normal(const PairGeometry<T>& pair, const T* history = nullptr,
                           [[maybe_unused]] const PairParameters<T>& parameters = {}) const {
    NormalResponse<T> response{T(0), T(0), T(0), T(0), T(0)};
    [[maybe_unused]] PackedHistory<history_size<Normal>(2), T> fresh{};
    history = present_history(pair, history, fresh);
    if constexpr (kKeepsOverlap) {
      response.elastic = repulsion.force(pair, history);
      response.stiffness = repulsion.stiffness(pair, history);
    } else {
      response.elastic = repulsion.force(pair);
      response.stiffness = repulsion.stiffness(pair);
    }
    // A law that is stiffer in unloading than in loading declares its stiffness for small reversible motions by
    // elastic_stiffness(), because elastic moduli must not depend on the direction of the last motion. A law without
    // this function counts as equally stiff in both directions.
    response.elastic_stiffness = response.stiffness;
    if constexpr (requires { repulsion.elastic_stiffness(pair, history); })
      response.elastic_stiffness = repulsion.elastic_stiffness(pair, history);
    response.touches = in_touch(pair, history);
    if constexpr (requires { repulsion.shear_stiffness(pair); })
      response.shear_stiffness = repulsion.shear_stiffness(pair);
    if constexpr (requires { repulsion.attraction(pair, history); })
      response.adhesive = repulsion.attraction(pair, history);
    // The adhesion changes `stiffness` and `elastic_stiffness`, because both are derivatives of the whole normal force.
    // For the attraction of a normal law, nothing is added: a normal law that attracts by itself returns the stiffness
    // of its whole force.
    if constexpr (kHoldsLiquid) {
      response.adhesive = adhesion.force(pair, parameters);
      add_stiffness(adhesion.stiffness(pair, parameters), response);
    } else if constexpr (kHasAdhesion) {
      response.adhesive = adhesion.force(pair);
      add_stiffness(adhesion.stiffness(pair), response);
    }
    return response;
  }
  /// Returns the static normal force of a contact with this history, its elastic and adhesive parts and its
  /// stiffnesses.
  template <int Dim>
  NormalResponse<double> normal_of(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history,
                                   const PairParameters<>& parameters = {}) const {
    return normal(pair, normal_history(history), parameters);
  }

  /// Returns the energy that the normal law stores in a contact with the elastic force N = `elastic` and the
  /// normal stiffness K_N = `k_n`. If the force is a power of the overlap d, the energy is N^2 d/(N + K_N d),
  /// which is N d/2 for linear contacts and (2/5) N d for Hertz contacts. Other laws compute the energy from
  /// the gap and the history.
  template <class T>
  T elastic_energy(const PairGeometry<T>& pair, const T& elastic, const T& k_n,
                   [[maybe_unused]] const T* history = nullptr) const {
    if constexpr (requires { repulsion.energy(pair, history); }) {
      [[maybe_unused]] PackedHistory<history_size<Normal>(2), T> fresh{};
      return repulsion.energy(pair, present_history(pair, history, fresh));
    } else {
      if (!(T(0) < elastic) || !(pair.gap < T(0))) return T(0);
      return elastic * elastic * -pair.gap / (elastic - k_n * pair.gap);
    }
  }
  /// Returns the energy that the elastic normal force stores in a contact with this history.
  template <int Dim>
  double elastic_energy_of(const PairGeometry<>& pair, double elastic, double k_n,
                           const PackedHistory<kHistorySize<Dim>>& history) const {
    return elastic_energy(pair, elastic, k_n, normal_history(history));
  }
  template <int Dim>
  double attraction_energy_of(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history,
                              const PairParameters<>& parameters) const {
    return attraction_energy(pair, normal_history(history), parameters);
  }
  /// Returns the energy of the attraction between two grains. The energy is zero at gaps beyond the range of the
  /// attraction.
  /// @param parameters  parameters of the pair that are in effect now, see acting()
  template <class T>
  T attraction_energy([[maybe_unused]] const PairGeometry<T>& pair, [[maybe_unused]] const T* history = nullptr,
                      [[maybe_unused]] const PairParameters<T>& parameters = {}) const {
    if constexpr (requires { repulsion.attraction_energy(pair, history); }) {
      [[maybe_unused]] PackedHistory<history_size<Normal>(2), T> fresh{};
      return repulsion.attraction_energy(pair, present_history(pair, history, fresh));
    } else if constexpr (kHoldsLiquid)
      return adhesion.energy(pair, parameters);
    else if constexpr (kHasAdhesion)
      return adhesion.energy(pair);
    return T(0);
  }
  /// Returns the energy of the normal force of a contact, the sum of its elastic and adhesive energy. Without
  /// `history`, the contact counts as new.
  template <class T>
  T energy(const PairGeometry<T>& pair, const T* history = nullptr,
           const PairParameters<T>& parameters = {}) const {
    const NormalResponse<T> response = normal(pair, history, parameters);
    T k_n = response.elastic_stiffness;
    if constexpr (kHoldsLiquid)
      k_n -= adhesion.stiffness(pair, parameters);
    else if constexpr (kHasAdhesion)
      k_n -= adhesion.stiffness(pair);
    return elastic_energy(pair, response.elastic, k_n, history) + attraction_energy(pair, history, parameters);
  }

  /// Returns the damping coefficient (force * time/length) of a pair of grains; 0 without damping. If the damping
  /// follows the present normal stiffness (kDampingFollowsStiffness), the coefficient is divided by the square root of
  /// this stiffness.
  double damping_coefficient([[maybe_unused]] const CollisionMass& mass) const {
    if constexpr (kHasDamping) return damping.coefficient(mass, repulsion);
    return 0.0;
  }

  /// Updates the history of a contact after the relative motion `motion`, and returns the forces of the contact.
  /// Springs are shortened so that their forces do not exceed their caps. When the surfaces part, the elongations of
  /// the springs become zero.
  template <int Dim, class T>
  ContactForces<Dim, T> respond(const ContactMotion<Dim, T>& motion,
                                PackedHistory<kHistorySize<Dim>, T>& history,
                                const PairParameters<T>& parameters = {}) const {
    const PairGeometry<T>& pair = motion.pair;
    if constexpr (kKeepsOverlap) repulsion.remember(pair, history.value);
    PairParameters<T> acting = parameters;
    if constexpr (kHoldsLiquid) acting = adhesion.hold(pair, parameters, history.value + kAdhesionBegin<Dim>);
    ContactForces<Dim, T> forces{normal(pair, normal_history(history), acting), T(0), Shear<Dim, T>::Zero(),
                                 RotationVector<Dim, T>::Zero()};
    if constexpr (kHasDamping)
      forces.viscous = lanes::select(forces.normal.touches,
                                     T(damping.force(motion.damping, forces.normal, motion.gap_rate)), T(0));
    // The cap on the force of a spring is proportional to the elastic normal force. Between surfaces that do not touch,
    // this force is zero, so their springs are shortened to zero.
    if constexpr (kHasFriction)
      forces.shear = friction.respond(pair, forces.normal, motion.slip, history.value + kTangentialBegin<Dim>);
    if constexpr (kHasRolling)
      forces.rolling =
          rolling.respond(pair, forces.normal, motion.relative_rotation, history.value + kRollingBegin<Dim>);
    if constexpr (kHasTwisting)
      forces.twisting = twisting.respond(forces.normal, motion.twist, history.value + kTwistingBegin<Dim>);
    return forces;
  }

  /// Returns the stiffnesses of a contact in the elastic network of contacts. Every spring counts as elastic, even if
  /// its force is at its cap.
  template <int Dim>
  ContactStiffness stiffness(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history,
                             const PairParameters<>& parameters = {}) const {
    const NormalResponse<double> response =
        normal(pair, normal_history(history), acting<Dim>(parameters, history));
    return response.touches ? touching(response) : ContactStiffness{response.stiffness, 0.0, 0.0};
  }

  /// Returns the stiffnesses of a touching contact with the elastic normal force `elastic`. The gap of `pair` is not
  /// used.
  ContactStiffness stiffness_at_force(const PairGeometry<>& pair, double elastic) const {
    return touching(of_stiffness(elastic, repulsion.stiffness_at_force(pair, elastic)));
  }

  /// Returns upper bounds on the stiffnesses that a contact of this pair can have in a packing. The largest overlap,
  /// force and impact speed in the packing are given by `load`.
  ContactStiffness stiffness_bound(const PairGeometry<>& pair, const ContactLoad& load) const {
    return touching(of_stiffness(0.0, repulsion.stiffness_bound(pair, load)));
  }

  /// Returns which springs of a touching contact have forces at their caps. Every part of the program uses this
  /// criterion of sliding.
  /// @param tolerance  a force counts as being at its cap if it is below the cap by at most this fraction of the cap
  template <int Dim>
  Mobilised mobilised(double elastic, const PackedHistory<kHistorySize<Dim>>& history, double tolerance) const {
    Mobilised m;
    if constexpr (kHasFriction)
      m.sliding =
          friction.template is_mobilised<Shear<Dim>>(elastic, history.value + kTangentialBegin<Dim>, tolerance);
    if constexpr (kHasRolling)
      m.rolling = rolling.template is_mobilised<RotationVector<Dim>>(
          elastic, history.value + kRollingBegin<Dim>, tolerance);
    if constexpr (kHasTwisting)
      m.twisting = twisting.is_mobilised(elastic, history.value + kTwistingBegin<Dim>, tolerance);
    return m;
  }

  /// Sets the history of the normal model so that the contact has this elastic normal force at its present gap.
  template <int Dim>
  void set_elastic_force([[maybe_unused]] const PairGeometry<>& pair, [[maybe_unused]] double elastic,
                         [[maybe_unused]] PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kKeepsOverlap) repulsion.set_force(pair, elastic, history.value);
  }
  /// Sets the elongations of the springs of a contact so that they exert the given force and moments at the stiffnesses
  /// `k`. The signs are defined as in ContactForces.
  template <int Dim>
  void set_force(const Shear<Dim>& shear, const RotationVector<Dim>& rolling_moment,
                 [[maybe_unused]] double twisting_moment, const ContactStiffness& k,
                 PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kHasFriction)
      if (k.tangential > 0.0) friction.set_force(shear, k.tangential, history.value + kTangentialBegin<Dim>);
    if constexpr (kHasRolling)
      if (k.rolling > 0.0) rolling.set_force(rolling_moment, k.rolling, history.value + kRollingBegin<Dim>);
    if constexpr (kHasTwisting)
      if (k.twisting > 0.0)
        twisting.set_force(twisting_moment, k.twisting, history.value + kTwistingBegin<Dim>);
  }

  /// Whether the normal law has a history, so that its force and energy depend on the loading path.
  static constexpr bool kKeepsOverlap = history_size<Normal>(2) > 0;

 private:
  /// Returns `history`, or the history of a new contact at this gap if `history` is null.
  /// @param fresh  memory for the history of a new contact
  template <class T, class Fresh>
  const T* present_history([[maybe_unused]] const PairGeometry<T>& pair, const T* history,
                           [[maybe_unused]] Fresh& fresh) const {
    if constexpr (kKeepsOverlap)
      if (history == nullptr) {
        repulsion.remember(pair, fresh.value);
        return fresh.value;
      }
    return history;
  }

  template <class T>
  static void add_stiffness(const T& of_adhesion, NormalResponse<T>& response) {
    response.stiffness += of_adhesion;
    response.elastic_stiffness += of_adhesion;
  }

  /// Returns whether the surfaces of a contact touch. Surfaces touch if they overlap, unless the normal law defines
  /// another criterion. Another criterion is needed if surfaces can stick together across a gap, or can part while they
  /// still overlap.
  template <class T>
  typename NormalResponse<T>::Mask in_touch(const PairGeometry<T>& pair,
                                            [[maybe_unused]] const T* history) const {
    if constexpr (requires { repulsion.touches(pair, history); })
      return repulsion.touches(pair, history);
    else
      return pair.gap < T(0);
  }

  /// Returns the NormalResponse of a touching contact from its elastic force and its normal stiffness K_N alone.
  NormalResponse<double> of_stiffness(double elastic, double k_n) const {
    NormalResponse<double> response{elastic, 0.0, k_n, k_n};
    if constexpr (requires { repulsion.shear_ratio(); })
      response.shear_stiffness = repulsion.shear_ratio() * k_n;
    return response;
  }

  template <int Dim>
  static constexpr int kTangentialBegin = history_size<Normal>(Dim);
  template <int Dim>
  static constexpr int kRollingBegin = kTangentialBegin<Dim> + history_size<Tangential>(Dim);
  template <int Dim>
  static constexpr int kTwistingBegin = kRollingBegin<Dim> + history_size<Rolling>(Dim);
  template <int Dim>
  static constexpr int kAdhesionBegin = kTwistingBegin<Dim> + history_size<Twisting>(Dim);

  template <int Size, class T>
  static const T* normal_history(const PackedHistory<Size, T>& history) {
    if constexpr (kKeepsOverlap) return history.value;
    return nullptr;
  }

  /// Returns the stiffnesses of a contact whose surfaces touch.
  ContactStiffness touching(const NormalResponse<double>& response) const {
    ContactStiffness k{response.elastic_stiffness, 0.0, 0.0};
    if constexpr (kHasFriction) k.tangential = friction.stiffness(response);
    if constexpr (kHasRolling) k.rolling = rolling.stiffness(response);
    if constexpr (kHasTwisting) k.twisting = twisting.stiffness(response);
    return k;
  }
};

}  // namespace floc
