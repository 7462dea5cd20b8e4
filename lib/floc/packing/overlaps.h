#pragma once

#include <string>

#include "floc/packing/packing.h"

namespace floc {

/// Overlap of two grains, over the smaller radius, up to which contact laws are meant: beyond it the contact
/// circle of spheres is a third of the radius, and the contacts of a grain affect each other.
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

/// Solid fraction that no packing of equal hard grains exceeds: that of the triangular lattice of disks, of the
/// face-centred cubic one of spheres.
constexpr double densest_of_equal(int dim) {
  return dim == 2 ? 0.906899682117109 : 0.740480489693061;
}

/// A warning about a packing that its stiffness lets overlap too far, or whose equal grains are denser than hard
/// ones can be, with what is likely to blame; empty where there is nothing to warn of. Some soft packings are
/// meant: nothing is refused.
template <int Dim>
std::string overlap_warning(const Packing<Dim>& packing);

/// "is K_N = 10 in the units of lengths and forces?": the question to ask where grains overlap too far.
std::string question_of_units(const Law& law);

/// @throws InputError at `place` if the law is for small overlaps and the mean of all is beyond kDeepestMean
template <int Dim>
void require_small_overlaps(const std::string& place, const Packing<Dim>& packing);

}  // namespace floc
