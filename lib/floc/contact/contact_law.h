#pragma once

#include <type_traits>

#include "floc/base/vec.h"
#include "floc/contact/absent.h"
#include "floc/contact/adhesion/constant_adhesion.h"
#include "floc/contact/adhesion/tail_adhesion.h"
#include "floc/contact/capped_spring.h"
#include "floc/contact/damping/viscous_damping.h"
#include "floc/contact/normal/linear_repulsion.h"
#include "floc/contact/normal_response.h"
#include "floc/contact/rolling/rolling_spring.h"
#include "floc/contact/tangential/coulomb_friction.h"
#include "floc/geometry/frame.h"

namespace floc {

/// Memory of one contact under a law: the springs of the slots the law has, and no byte for those it lacks.
template <class Law, int Dim, class T = double>
struct ContactHistory {
  struct NoShear {};
  struct NoRoll {};
  [[no_unique_address]] std::conditional_t<Law::kHasFriction, Shear<Dim, T>, NoShear> shear;
  [[no_unique_address]] std::conditional_t<Law::kHasRolling, Spin<Dim, T>, NoRoll> roll;

  /// A new contact: springs at rest.
  ContactHistory() {
    if constexpr (Law::kHasFriction) shear.setZero();
    if constexpr (Law::kHasRolling) roll.setZero();
  }
};

/// Relative motion of the two surfaces of a contact.
template <int Dim, class T = double>
struct ContactMotion {
  T gap;                       ///< h (length), negative when the grains overlap
  T gap_rate;                  ///< dh/dt (length/time)
  T damping;                   ///< damping coefficient of the pair (force * time/length)
  Shear<Dim, T> slip;          ///< tangential displacement of j against i since the history was last updated
  Spin<Dim, T> relative_turn;  ///< rotation of i against j since then (radians)
};

/// What a contact does to its grains. On j act +normal along n and -shear; on i the opposite. On i acts the moment
/// -rolling besides that of the shear force, on j +rolling.
template <int Dim, class T = double>
struct ContactForces {
  NormalResponse<T> normal;  ///< static normal response
  T viscous;                 ///< dashpot force, compression positive; no part of the static force
  Shear<Dim, T> shear;       ///< K_T times the spring: tangential force on i, in the contact's frame (force)
  Spin<Dim, T> rolling;      ///< K_R times the relative rotation: moment on j (force * length)
};

/// Stiffnesses of one contact for the network: along the normal, across it, and against rolling.
struct ContactStiffness {
  double normal;      ///< K_N, or -F0/D0 of a distant attraction (force/length)
  double tangential;  ///< K_T (force/length), 0 when the surfaces do not touch
  double rolling;     ///< K_R (force * length), 0 when they do not touch
};

/// A contact law composed of slots; an absent slot (contact/absent.h) has no member, no branch and no history.
/// Every function is a template on its number type and free of branches on values.
template <class Normal, class Adhesion, class Damping, class Tangential, class Rolling>
struct ContactLaw {
  static constexpr bool kHasAdhesion = !std::is_same_v<Adhesion, NoAdhesion>;
  static constexpr bool kHasDamping = !std::is_same_v<Damping, NoDamping>;
  static constexpr bool kHasFriction = !std::is_same_v<Tangential, NoFriction>;
  static constexpr bool kHasRolling = !std::is_same_v<Rolling, NoRolling>;

  [[no_unique_address]] Normal repulsion;
  [[no_unique_address]] Adhesion adhesion;
  [[no_unique_address]] Damping damping;
  [[no_unique_address]] Tangential friction;
  [[no_unique_address]] Rolling rolling;

  /// Largest gap at which the law still acts (length); the neighbour cutoff derives from it.
  double range() const {
    if constexpr (kHasAdhesion) return adhesion.range();
    return 0.0;
  }

  /// Static normal response at a gap.
  template <class T>
  NormalResponse<T> normal(const T& gap) const {
    NormalResponse<T> response{repulsion.force(gap), T(0), repulsion.stiffness(gap)};
    if constexpr (kHasAdhesion) {
      response.adhesive = adhesion.force(gap);
      response.stiffness += adhesion.stiffness(gap);
    }
    return response;
  }

  /// Potential energy of the static normal force, zero beyond the range.
  template <class T>
  T energy(const T& gap) const {
    T u = repulsion.energy(gap);
    if constexpr (kHasAdhesion) u += adhesion.energy(gap);
    return u;
  }

  /// Damping coefficient of a pair of grains (force * time/length), 0 without damping.
  double damping_coefficient(double mass_i, double mass_j) const {
    if constexpr (kHasDamping) return damping.coefficient(mass_i, mass_j, repulsion.normal_stiffness);
    return 0.0;
  }

  /// Updates the history by one motion and returns the forces. Springs are cut back to their caps, and vanish when
  /// the surfaces part.
  template <int Dim, class T>
  ContactForces<Dim, T> respond(const ContactMotion<Dim, T>& motion,
                                ContactHistory<ContactLaw, Dim, T>& history) const {
    ContactForces<Dim, T> forces{normal(motion.gap), T(0), Shear<Dim, T>::Zero(), Spin<Dim, T>::Zero()};
    if constexpr (kHasDamping)
      forces.viscous = lanes::select(motion.gap < T(0), T(-motion.damping * motion.gap_rate), T(0));
    // A parted contact has no elastic force, so the caps also clear its springs.
    if constexpr (kHasFriction) {
      history.shear =
          capped(Shear<Dim, T>(history.shear + motion.slip), friction.spring_limit(forces.normal.elastic));
      forces.shear = T(friction.tangential_stiffness) * history.shear;
    }
    if constexpr (kHasRolling) {
      history.roll = capped(Spin<Dim, T>(history.roll + motion.relative_turn),
                            rolling.spring_limit(forces.normal.elastic));
      forces.rolling = T(rolling.rolling_stiffness) * history.roll;
    }
    return forces;
  }

  /// Stiffnesses a contact at this gap has in the network (nothing sliding).
  ContactStiffness stiffness(double gap) const {
    ContactStiffness k{normal(gap).stiffness, 0.0, 0.0};
    if (gap >= 0.0) return k;
    if constexpr (kHasFriction) k.tangential = friction.tangential_stiffness;
    if constexpr (kHasRolling) k.rolling = rolling.rolling_stiffness;
    return k;
  }
};

}  // namespace floc
