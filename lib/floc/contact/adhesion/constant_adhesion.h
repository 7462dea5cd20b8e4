#pragma once

#include "floc/base/lanes.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Constant attraction between grains. The force is -F0 while the surfaces overlap, where F0 is the pull-off force, and
/// zero across a gap. This is the limit of `TailAdhesion` for a range that tends to zero.
struct ConstantAdhesion {
  double pull_off_force;  ///< pull-off force F0 (force), > 0

  static constexpr const char* kKeyword = "constant";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kGoesWithRigid = true;
  static constexpr bool kIsInEveryFile = true;
  static constexpr Number<ConstantAdhesion> kNumbers[] = {
      {"force", &ConstantAdhesion::pull_off_force, Unit::force, "F0", Requirement::not_negative,
       "a positive number (F0, the pull-off force); leave out contact.adhesion for grains without adhesion",
       "pull-off force", Requirement::positive}};

  template <class T>
  T force(const PairGeometry<T>& pair) const {
    return lanes::select(pair.gap < T(0), T(-pull_off_force), T(0));
  }
  template <class T>
  T stiffness(const PairGeometry<T>&) const {
    return T(0);
  }
  template <class T>
  T energy(const PairGeometry<T>& pair) const {
    return lanes::select(pair.gap < T(0), T(pull_off_force * pair.gap), T(0));
  }
  double range() const { return 0.0; }
  /// Returns whether the grains attract each other, that is, whether the force is not zero.
  bool acts() const { return pull_off_force != 0.0; }

  bool operator==(const ConstantAdhesion&) const = default;
};

}  // namespace floc
