#pragma once

#include <optional>

#include "floc/base/vec.h"

namespace floc {

/// Stresses and strains in one equilibrium of a mechanical test with one driven axis. Compression is positive.
struct AxialTest {
  double mean_stress = 0.0;  ///< mean stress p (force/length^(Dim-1))
  /// Deviator q: stress on the driven axis minus the mean stress on the other axes.
  double deviator = 0.0;
  /// Ratio K0: mean stress on the other axes divided by the stress on the driven axis.
  double lateral_ratio = 0.0;
  /// Logarithmic volumetric strain, with the same reference state as the strains passed to measure_axial_test().
  double volumetric_strain = 0.0;
  /// Mobilised friction: (s1 - s2)/(s1 + s2) = q/(2 p) in 2D, q/p in 3D. Here s1 is the stress on the driven axis and,
  /// in 2D, s2 the stress on the other axis; q is the deviator and p the mean stress.
  double mobilised = 0.0;
  /// Dilatancy -(change of eps_v)/(change of eps_q) since the previous equilibrium, where eps_v is the volumetric
  /// strain. The strain eps_q is eps_1 - eps_2 in 2D, and 2/3 (eps_1 - eps_3) in 3D. Here eps_1 is the strain of the
  /// driven axis, eps_2 the strain of the other axis in 2D, and eps_3 the mean strain of the other axes in 3D. Absent
  /// if eps_q does not change, or for the first equilibrium.
  std::optional<double> dilatancy;
};

/// Computes the stresses and strains in one equilibrium of a mechanical test with one driven axis.
/// @param axis            index of the driven axis, from 0
/// @param stress, strain  stress and logarithmic strain of each axis; any reference state of the strain is allowed
/// @param strain_before   strain of the previous equilibrium, from the same reference state; null if there is none
template <int Dim>
AxialTest measure_axial_test(int axis, const Vec<Dim>& stress, const Vec<Dim>& strain,
                             const Vec<Dim>* strain_before);

/// Returns the logarithmic strain of each axis between two states of a cell. The strain follows from the lengths of the
/// sides in both states; shortening is positive.
template <int Dim>
Vec<Dim> axial_strain(const Vec<Dim>& sides_before, const Vec<Dim>& sides) {
  return (sides_before.array() / sides.array()).log();
}

}  // namespace floc
