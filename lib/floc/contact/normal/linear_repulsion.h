#pragma once

#include <cmath>

#include "floc/base/lanes.h"
#include "floc/contact/contact_load.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Linear elastic repulsion FNe = -K_N h while the surfaces overlap (h < 0), else 0. [GRC2008], Eq. 1.
struct LinearRepulsion {
  double normal_stiffness;  ///< K_N (force/length)

  static constexpr const char* kKeyword = "linear";
  static constexpr Family kFamily = Family::springs;
  static constexpr bool kIsInEveryFile = true;
  static constexpr Number<LinearRepulsion> kNumbers[] = {
      {"stiffness", &LinearRepulsion::normal_stiffness, Unit::stiffness, "K_N", Requirement::positive,
       "a positive number (K_N, force per length)", "normal stiffness"}};

  template <class T>
  T force(const PairGeometry<T>& pair) const {
    return lanes::select(pair.gap < T(0), T(-normal_stiffness * pair.gap), T(0));
  }
  template <class T>
  T stiffness(const PairGeometry<T>& pair) const {
    return lanes::select(pair.gap < T(0), T(normal_stiffness), T(0));
  }
  /// K_N at an elastic force > 0, for a contact of which only the force is known (force/length).
  double stiffness_at_force(const PairGeometry<>&, double) const { return normal_stiffness; }
  /// Modulus that reduces pressures of a packing of grains of diameter a: K_N/a^(Dim-2) (force/length^(Dim-1)).
  double modulus_of_packing(int dim, double diameter) const {
    return normal_stiffness / std::pow(diameter, dim - 2);
  }
  /// Upper bound of K_N of a contact (force/length).
  double stiffness_bound(const PairGeometry<>&, const ContactLoad&) const { return normal_stiffness; }

  bool operator==(const LinearRepulsion&) const = default;
};

}  // namespace floc
