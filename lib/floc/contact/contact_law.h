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

/// Relative motion of the two surfaces of a contact.
template <int Dim, class T = double>
struct ContactMotion {
  PairGeometry<T> pair;  ///< geometry at the end of the motion
  T gap_rate;            ///< dh/dt (length/time)
  T damping;             ///< damping coefficient of the pair (damping_coefficient())
  Shear<Dim, T> slip;    ///< tangential displacement of j against i since the history was last updated
  /// Rolling of i against j since the history was last updated (radians), see rolling_part().
  RotationVector<Dim, T> relative_rotation;
  /// For spheres, rotation of i against j about the normal since the history was last updated (radians).
  T twist = T(0);
};

/// Forces of a contact on its grains. The forces on j are +normal along n and -shear, those on i the opposite.
/// The moments on i are -rolling and -twisting n, besides the moment of the shear force; those on j are
/// +rolling and +twisting n, besides the moment of the shear force.
template <int Dim, class T = double>
struct ContactForces {
  NormalResponse<T> normal;        ///< static normal response
  T viscous;                       ///< dashpot force, compression positive; not part of the static force
  Shear<Dim, T> shear;             ///< tangential force on i, in the contact's frame (force)
  RotationVector<Dim, T> rolling;  ///< moment on j (force * length)
  T twisting = T(0);               ///< for spheres, moment on j about n (force * length)
};

/// Stiffnesses of one contact for the network: along the normal, across it, and against rolling and
/// twisting.
struct ContactStiffness {
  double normal;          ///< K_N of small reversible motions, or -F0/D0 of a distant attraction (force/length)
  double tangential;      ///< K_T (force/length), 0 when the surfaces do not touch
  double rolling;         ///< K_R (force * length), 0 when they do not touch
  double twisting = 0.0;  ///< K_tw (force * length), 0 when they do not touch
};

/// Pair parameters, besides the geometry, of laws that have none.
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

/// A contact law composed of slots; an absent slot (contact/absent.h) has no member, no branch and no history.
/// Every function that dynamics calls is a template on its number type and free of branches on values.
template <class Normal, class Adhesion, class Damping, class Tangential, class Rolling, class Twisting>
struct ContactLaw {
  static constexpr bool kHasAdhesion = !kIsAbsent<Adhesion>;
  static constexpr bool kHasDamping = !kIsAbsent<Damping>;
  static constexpr bool kHasFriction = !kIsAbsent<Tangential>;
  static constexpr bool kHasRolling = !kIsAbsent<Rolling>;
  static constexpr bool kHasTwisting = !kIsAbsent<Twisting>;
  static constexpr bool kHoldsLiquid = floc::kHoldsLiquid<Adhesion>;
  /// Whether the damping coefficient has to be multiplied by the root of the stiffness.
  static constexpr bool kDampingFollowsStiffness = kFollowsNormalStiffness<Damping>;
  /// Dimension that the law is for; 0: any.
  static constexpr int kDimension =
      std::max({kDimensionOf<Normal>, kDimensionOf<Tangential>, kDimensionOf<Twisting>});

  /// Whether the law reads the reduced radius or the reduced mass of a pair. They are loaded only for laws that
  /// do.
  static constexpr bool kNeedsReducedRadius = requires { requires Normal::kNeedsReducedRadius; }
  || requires { requires Adhesion::kNeedsReducedRadius; };
  static constexpr bool kNeedsReducedMass = requires { requires Normal::kNeedsReducedMass; }
  || requires { requires Adhesion::kNeedsReducedMass; };

  /// Parameters that differ from pair to pair and follow from its radii and its history; most laws have none.
  /// They are computed once (pair_parameters()), not for every force.
  template <class T = double>
  using PairParameters = typename detail::PairParametersOf<Adhesion, T>::Type;

  /// Size of the history of a contact: the numbers of the normal, the tangential, the rolling, the twisting and
  /// the adhesion slot, in this order.
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

  /// Largest gap at which surfaces that have not met act on each other (length).
  double range() const {
    if constexpr (kHasAdhesion) return adhesion.range();
    return 0.0;
  }
  /// Largest gap at which surfaces that have met may still touch (length): 0 unless the normal law holds them
  /// together.
  double holding_range([[maybe_unused]] double reduced_radius) const {
    if constexpr (requires { repulsion.holding_range(reduced_radius); })
      return repulsion.holding_range(reduced_radius);
    return 0.0;
  }

  /// Whether surfaces with this history belong to the contact list: they touch, overlap, attract each other across
  /// the gap or hold liquid.
  template <int Dim>
  bool interacts(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kHoldsLiquid)
      if (history.value[kAdhesionBegin<Dim>] != 0.0) return true;
    return pair.gap < 0.0 || pair.gap < range() || touches<Dim>(pair, history);
  }

  /// Parameters of a pair of grains with these radii (length) and this history.
  template <int Dim>
  PairParameters<> pair_parameters([[maybe_unused]] double radius_i, [[maybe_unused]] double radius_j,
                                   [[maybe_unused]] const PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kHoldsLiquid)
      return adhesion.bridge(radius_i, radius_j, std::abs(history.value[kAdhesionBegin<Dim>]));
    else
      return {};
  }
  /// Pair parameters as they act now, for a pair that has not moved since its history was updated.
  template <int Dim>
  PairParameters<> acting(const PairParameters<>& parameters,
                          [[maybe_unused]] const PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kHoldsLiquid)
      return adhesion.acting(parameters, history.value[kAdhesionBegin<Dim>]);
    else
      return parameters;
  }

  /// Whether the surfaces of a contact touch (NormalResponse::touches).
  template <int Dim>
  bool touches(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history) const {
    return in_touch(pair, normal_history(history));
  }

  /// Static normal response of a pair.
  /// @param history  of the normal slot; null for a new contact
  /// @param parameters  as they act
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
    response.elastic_stiffness = response.stiffness;
    if constexpr (requires { repulsion.elastic_stiffness(pair, history); })
      response.elastic_stiffness = repulsion.elastic_stiffness(pair, history);
    response.touches = in_touch(pair, history);
    if constexpr (requires { repulsion.shear_stiffness(pair); })
      response.shear_stiffness = repulsion.shear_stiffness(pair);
    if constexpr (requires { repulsion.attraction(pair, history); })
      response.adhesive = repulsion.attraction(pair, history);
    if constexpr (kHoldsLiquid) {
      response.adhesive = adhesion.force(pair, parameters);
      add_stiffness(adhesion.stiffness(pair, parameters), response);
    } else if constexpr (kHasAdhesion) {
      response.adhesive = adhesion.force(pair);
      add_stiffness(adhesion.stiffness(pair), response);
    }
    return response;
  }
  /// Static normal response of a contact with this history.
  template <int Dim>
  NormalResponse<double> normal_of(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history,
                                   const PairParameters<>& parameters = {}) const {
    return normal(pair, normal_history(history), parameters);
  }

  /// Energy that the normal law stores in a contact, given its elastic force and its K_N. Where the force is a
  /// power of the overlap h, these two determine it: N^2 h/(N + K_N h), which is N h/2 for linear contacts and
  /// (2/5) N h for Hertz contacts. Other laws give the energy as a function of the gap and the history.
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
  /// Energy of the elastic part of the normal force (elastic_energy()), and of the attraction
  /// (attraction_energy()), of a contact with this history.
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
  /// Energy of the attraction, zero where the attraction ends.
  /// @param parameters  as they act
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
  /// Energy of a contact along its normal, elastic and attractive; of a new contact where no history is given.
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

  /// Damping coefficient of a pair of grains (force * time/length), divided by the root of the stiffness where
  /// damping follows the stiffness; 0 without damping.
  double damping_coefficient([[maybe_unused]] const CollisionMass& mass) const {
    if constexpr (kHasDamping) return damping.coefficient(mass, repulsion);
    return 0.0;
  }

  /// Updates the history by one motion and returns the forces. Springs are cut back to their caps, and vanish
  /// when the surfaces part.
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
    // Surfaces that do not touch have no elastic force, so that the caps also clear the springs.
    if constexpr (kHasFriction)
      forces.shear = friction.respond(pair, forces.normal, motion.slip, history.value + kTangentialBegin<Dim>);
    if constexpr (kHasRolling)
      forces.rolling =
          rolling.respond(pair, forces.normal, motion.relative_rotation, history.value + kRollingBegin<Dim>);
    if constexpr (kHasTwisting)
      forces.twisting = twisting.respond(forces.normal, motion.twist, history.value + kTwistingBegin<Dim>);
    return forces;
  }

  /// Stiffnesses of a contact in the network, where no spring counts as mobilised.
  template <int Dim>
  ContactStiffness stiffness(const PairGeometry<>& pair, const PackedHistory<kHistorySize<Dim>>& history,
                             const PairParameters<>& parameters = {}) const {
    const NormalResponse<double> response =
        normal(pair, normal_history(history), acting<Dim>(parameters, history));
    return response.touches ? touching(response) : ContactStiffness{response.stiffness, 0.0, 0.0};
  }

  /// Stiffnesses of a touching contact of which only the elastic force is known.
  ContactStiffness stiffness_at_force(const PairGeometry<>& pair, double elastic) const {
    return touching(of_stiffness(elastic, repulsion.stiffness_at_force(pair, elastic)));
  }

  /// Upper bounds of the stiffnesses of a contact of this pair under this load.
  ContactStiffness stiffness_bound(const PairGeometry<>& pair, const ContactLoad& load) const {
    return touching(of_stiffness(0.0, repulsion.stiffness_bound(pair, load)));
  }

  /// Springs of a touching contact that are at their caps. All code of the program uses this criterion of
  /// sliding.
  /// @param tolerance  relative distance below the cap that still counts as being at it
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

  /// Sets the history of the normal law so that a contact has this elastic force at its gap.
  template <int Dim>
  void set_elastic_force([[maybe_unused]] const PairGeometry<>& pair, [[maybe_unused]] double elastic,
                         [[maybe_unused]] PackedHistory<kHistorySize<Dim>>& history) const {
    if constexpr (kKeepsOverlap) repulsion.set_force(pair, elastic, history.value);
  }
  /// Sets the springs so that they carry given forces (signs of ContactForces) at given stiffnesses.
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

  /// Whether the normal law keeps a history: its force and energy then depend on the loading path.
  static constexpr bool kKeepsOverlap = history_size<Normal>(2) > 0;

 private:
  /// Returns the given history, or the history of a new contact at this gap where it is null.
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

  /// Whether the surfaces touch: they overlap, unless the normal law has a criterion of its own, as where
  /// surfaces hold together across a gap or part while they still overlap.
  template <class T>
  typename NormalResponse<T>::Mask in_touch(const PairGeometry<T>& pair,
                                            [[maybe_unused]] const T* history) const {
    if constexpr (requires { repulsion.touches(pair, history); })
      return repulsion.touches(pair, history);
    else
      return pair.gap < T(0);
  }

  /// Response when only the elastic force and K_N are known.
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

  /// Stiffnesses when the surfaces touch.
  ContactStiffness touching(const NormalResponse<double>& response) const {
    ContactStiffness k{response.elastic_stiffness, 0.0, 0.0};
    if constexpr (kHasFriction) k.tangential = friction.stiffness(response);
    if constexpr (kHasRolling) k.rolling = rolling.stiffness(response);
    if constexpr (kHasTwisting) k.twisting = twisting.stiffness(response);
    return k;
  }
};

}  // namespace floc
