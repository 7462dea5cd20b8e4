#pragma once

#include <array>

#include "floc/packing/packing.h"

namespace floc {

/// Moments of the forces, and mobilisation of friction, of all contacts between grains that touch (docs/physics.md,
/// "Force network"). All values are zero if there are no contacts.
struct ForceMoments {
  double mean_normal = 0.0;  ///< mean `<N>` of the elastic normal force N (force)
  double largest = 0.0;      ///< largest elastic normal force N (force)
  /// Reduced moments `Z(q) = <N^q>/<N>^q` of the elastic normal force N, for q = 2, 3, 4. Without adhesion, N is the
  /// total normal force.
  std::array<double, 3> Z{};
  /// Means of |F_T|/N, the tangential force divided by the elastic normal force. M1 is the mean over the contacts with
  /// N > `<N>`, and M2 the mean over the contacts with N <= `<N>`. Both are at most the coefficient of friction.
  double M1 = 0.0, M2 = 0.0;
};

/// Computes the statistical moments of the forces at contacts between grains.
template <int Dim>
ForceMoments force_moments(const Packing<Dim>& packing);

}  // namespace floc
