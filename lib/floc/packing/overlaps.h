#pragma once

#include <string>

#include "floc/packing/packing.h"

namespace floc {

/// Overlap of two spheres, over the smaller radius, up to which Hertz' contact law is meant: beyond it the
/// contact circle is a third of the radius, and the contacts of a sphere affect each other.
inline constexpr double kDeepOverlap = 0.1;
/// Mean overlap of a packing beyond which it is refused: at the largest pressure that scenes may ask for, a
/// stiffness level of 30, it is 0.11.
inline constexpr double kDeepestMean = 0.12;

/// How deep the contacts that touch overlap, over the smaller radius of each.
struct Overlaps {
  double mean = 0.0;
  double largest = 0.0;
  double deep_share = 0.0;  ///< of the contacts, beyond kDeepOverlap
};

template <int Dim>
Overlaps measure_overlaps(const Packing<Dim>& packing);

/// A warning about contacts of a packing that are too deep for its law, if this is one for small overlaps;
/// empty where there is nothing to warn of.
template <int Dim>
std::string overlap_warning(const Packing<Dim>& packing);

/// @throws InputError at `place` if the law is for small overlaps and the mean of all is beyond kDeepestMean
template <int Dim>
void require_small_overlaps(const std::string& place, const Packing<Dim>& packing);

}  // namespace floc
