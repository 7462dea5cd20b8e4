#pragma once

#include <cmath>

#include "floc/base/lanes.h"
#include "floc/contact/contact_load.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Linear elastic repulsion FNe = -K_N h with the normal stiffness K_N while the surfaces overlap (gap h < 0),
/// else 0. [GRC2008], Eq. 1.
struct LinearRepulsion {
  double normal_stiffness;  ///< normal stiffness K_N (force/length)

  static constexpr const char* kKeyword = "linear";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kIsInEveryFile = true;
  static constexpr Number<LinearRepulsion> kNumbers[] = {
      {"stiffness", &LinearRepulsion::normal_stiffness, Unit::stiffness, "K_N", Requirement::positive,
       "a positive number (normal stiffness K_N, force per length)", "normal stiffness"}};

  template <class T>
  T force(const PairGeometry<T>& pair) const {
    return lanes::select(pair.gap < T(0), T(-normal_stiffness * pair.gap), T(0));
  }
  template <class T>
  T stiffness(const PairGeometry<T>& pair) const {
    return lanes::select(pair.gap < T(0), T(normal_stiffness), T(0));
  }
  /// Returns the normal stiffness K_N of a contact (force/length), which does not depend on the force.
  double stiffness_at_force(const PairGeometry<>&, double) const { return normal_stiffness; }
  /// Returns the modulus (force/length^(Dim-1)) by which the pressures of a packing are divided to make them
  /// dimensionless. The modulus is K_N/a^(Dim-2), with the normal stiffness K_N and the diameter a of the grains.
  double modulus_of_packing(int dim, double diameter) const {
    return normal_stiffness / std::pow(diameter, dim - 2);
  }
  /// Returns an upper bound on the normal stiffness K_N (force/length) of a contact.
  double stiffness_bound(const PairGeometry<>&, const ContactLoad&) const { return normal_stiffness; }

  bool operator==(const LinearRepulsion&) const = default;
};

}  // namespace floc
