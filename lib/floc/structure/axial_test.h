#pragma once

#include <optional>

#include "floc/base/vec.h"

namespace floc {

/// Stresses and strains of a test with one driven axis, in one equilibrium. Compression counts positive.
struct AxialTest {
  double mean_stress = 0.0;        ///< p (force/length^(Dim-1))
  double deviator = 0.0;           ///< q: driven stress less the mean of the others
  double lateral_ratio = 0.0;      ///< K0: mean of the other stresses over the driven one
  double volumetric_strain = 0.0;  ///< logarithmic, from the reference
  double mobilised = 0.0;          ///< (s1 - s2)/(s1 + s2) = q/(2 p) in 2D, q/p in 3D
  /// -d eps_v/d eps_q since the previous state, eps_q = eps_1 - eps_2 in 2D, 2/3 (eps_1 - eps_3) in 3D; absent
  /// where eps_q does not change.
  std::optional<double> dilatancy;
};

/// Computes the results of a test in one equilibrium.
/// @param axis            index of the driven axis, from 0
/// @param stress, strain  stress and logarithmic strain of each axis, the strain from any reference
/// @param strain_before   strain of the previous equilibrium, from the same reference; null if there is none
template <int Dim>
AxialTest measure_axial_test(int axis, const Vec<Dim>& stress, const Vec<Dim>& strain,
                             const Vec<Dim>* strain_before);

/// Returns the logarithmic strains between two cells, from the lengths of their axes, shortening positive.
template <int Dim>
Vec<Dim> axial_strain(const Vec<Dim>& sides_before, const Vec<Dim>& sides) {
  return (sides_before.array() / sides.array()).log();
}

}  // namespace floc
