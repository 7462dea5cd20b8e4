#pragma once

#include <array>

#include "floc/packing/packing.h"

namespace floc {

/// Moments of the contact forces and mobilisation of friction (docs/physics.md, "Force network"), over contacts
/// that touch; all zero without any.
struct ForceMoments {
  double mean_normal = 0.0;  ///< `<N>`, of the elastic normal force N (force)
  double largest = 0.0;      ///< the largest N (force)
  /// `Z(q) = <N^q>/<N>^q`, q = 2, 3, 4; without adhesion N is the whole normal force.
  std::array<double, 3> Z{};
  /// Mean |F_T|/N over contacts whose N is above, and below, `<N>`; at most the coefficient of friction.
  double M1 = 0.0, M2 = 0.0;
};

/// Computes the moments over the contacts between grains.
template <int Dim>
ForceMoments force_moments(const Packing<Dim>& packing);

}  // namespace floc
