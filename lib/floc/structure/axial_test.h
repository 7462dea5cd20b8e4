#pragma once

#include <optional>

#include "floc/base/vec.h"

namespace floc {

/// Stresses and strains in one equilibrium of a mechanical test with one driven axis. Compression is positive.
struct AxialTest {
  double mean_stress = 0.0;  ///< mean stress p (force/length^(Dim-1))
  /// Deviator q: stress on the driven axis minus the mean of the other stresses.
  double deviator = 0.0;
  double lateral_ratio = 0.0;      ///< ratio K0: mean of the other stresses over the stress on the driven axis
  double volumetric_strain = 0.0;  ///< logarithmic volumetric strain, from the reference state
  /// Mobilised friction: (s1 - s2)/(s1 + s2) = q/(2 p) in 2D, q/p in 3D, with s1 the stress on the driven axis.
  double mobilised = 0.0;
  /// Dilatancy -d eps_v/d eps_q since the previous state, with eps_v the volumetric strain and eps_q = eps_1 -
  /// eps_2 in 2D, 2/3 (eps_1 - eps_3) in 3D; absent if eps_q does not change.
  std::optional<double> dilatancy;
};

/// Computes the stresses and strains of a test with one driven axis in one equilibrium.
/// @param axis            index of the driven axis, from 0
/// @param stress, strain  stress and logarithmic strain of each axis, the strain from any reference state
/// @param strain_before   strain of the previous equilibrium, from that reference state; null if there is no
/// previous equilibrium
template <int Dim>
AxialTest measure_axial_test(int axis, const Vec<Dim>& stress, const Vec<Dim>& strain,
                             const Vec<Dim>* strain_before);

/// Returns the logarithmic strain of each axis between two cells, from the lengths of their axes; shortening is
/// positive.
template <int Dim>
Vec<Dim> axial_strain(const Vec<Dim>& sides_before, const Vec<Dim>& sides) {
  return (sides_before.array() / sides.array()).log();
}

}  // namespace floc
