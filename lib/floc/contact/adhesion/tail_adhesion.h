#pragma once

#include "floc/base/lanes.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Attraction between grains that acts across a gap. In contact, the force is -F0, where F0 is the pull-off force.
/// Across a gap, the magnitude of the force decreases linearly from F0 to zero as the gap grows from 0 to the range D0.
/// The attraction is reversible: the force depends on the gap alone and is equal on approach and on separation.
/// [GRC2008], Eq. 2.
struct TailAdhesion {
  double pull_off_force;  ///< pull-off force F0 (force), > 0
  double tail_range;      ///< range D0 of the attraction (length), > 0

  static constexpr const char* kKeyword = "tail";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kIsInEveryFile = true;
  static constexpr Number<TailAdhesion> kNumbers[] = {
      {"force", &TailAdhesion::pull_off_force, Unit::force, "F0", Requirement::not_negative,
       "a positive number (F0, the pull-off force); leave out contact.adhesion for grains without adhesion",
       "pull-off force", Requirement::positive},
      {"range", &TailAdhesion::tail_range, Unit::length, "D0", Requirement::not_negative,
       "a positive number (range D0 of the attraction, a length)", "range of the attraction",
       Requirement::positive}};

  template <class T>
  T force(const PairGeometry<T>& pair) const {
    const T tail = lanes::min(T(0), T((pull_off_force / tail_range) * pair.gap - pull_off_force));
    return lanes::select(pair.gap < T(0), T(-pull_off_force), tail);
  }
  /// Returns the stiffness -dF/dh (force/length) of the adhesive normal force F <= 0 at the gap h. The stiffness is
  /// negative across a gap, because the attraction weakens as the grains part.
  template <class T>
  T stiffness(const PairGeometry<T>& pair) const {
    const T tail = lanes::select(pair.gap < T(tail_range), T(-pull_off_force / tail_range), T(0));
    return lanes::select(pair.gap < T(0), T(0), tail);
  }
  /// Returns the potential energy of the attraction. With the pull-off force F0 and the range D0, the energy is -F0
  /// D0/2 at zero gap, and zero if the gap is at least D0.
  template <class T>
  T energy(const PairGeometry<T>& pair) const {
    const T missing = lanes::max(T(0), T(tail_range - pair.gap));
    const T tail = T(-0.5 * pull_off_force / tail_range) * missing * missing;
    return lanes::select(pair.gap < T(0), T(pull_off_force * pair.gap - 0.5 * pull_off_force * tail_range),
                         tail);
  }
  double range() const { return tail_range; }
  /// Returns whether the grains attract each other, that is, whether the force is not zero.
  bool acts() const { return pull_off_force != 0.0; }

  bool operator==(const TailAdhesion&) const = default;
};

}  // namespace floc
