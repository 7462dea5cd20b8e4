#pragma once

#include <string>

#include "floc/packing/packing.h"

namespace floc {

/// Overlap of two grains over the smaller radius up to which contact laws are valid. Beyond it the contact
/// circle of spheres exceeds a third of the radius, and the contacts of a grain affect each other.
inline constexpr double kDeepOverlap = 0.1;
/// Mean overlap over the smaller radius beyond which a packing is refused. At the largest pressure that scenes
/// may impose, a stiffness level of 30, the mean overlap is 0.11.
inline constexpr double kDeepestMean = 0.12;

/// Overlaps of the contacts that touch, each over the smaller radius of its grains.
struct Overlaps {
  double mean = 0.0;
  double largest = 0.0;
  double deep_share = 0.0;  ///< share of these contacts whose overlap is beyond kDeepOverlap
};

template <int Dim>
Overlaps measure_overlaps(const Packing<Dim>& packing);

/// Largest solid fraction of equal hard grains: the triangular lattice of disks, the face-centred cubic lattice
/// of spheres.
constexpr double densest_of_equal(int dim) {
  return dim == 2 ? 0.906899682117109 : 0.740480489693061;
}

/// Warning about a packing whose grains overlap too far, or whose equal grains are denser than hard grains can
/// be, with the likely cause; empty if there is none. It is not an error, because soft packings may be
/// intended.
template <int Dim>
std::string overlap_warning(const Packing<Dim>& packing);

/// Question for messages about large overlaps: "is K_N = 10 in the units of lengths and forces?".
std::string question_of_units(const Law& law);

/// Requires small overlaps of a law that holds only for these.
/// @param place  place of the packing in messages
/// @throws InputError if the mean overlap is beyond kDeepestMean
template <int Dim>
void require_small_overlaps(const std::string& place, const Packing<Dim>& packing);

}  // namespace floc
