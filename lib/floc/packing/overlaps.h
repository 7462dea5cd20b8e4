#pragma once

#include <string>

#include "floc/packing/packing.h"

namespace floc {

/// Largest overlap, divided by the smaller radius of the two grains, at which contact laws are valid. Beyond it
/// the contact circle of spheres exceeds a third of the radius, and the contacts of a grain affect each other.
inline constexpr double kDeepOverlap = 0.1;
/// Mean overlap, divided by the smaller radius of the two grains, beyond which a packing is refused. At the
/// largest pressure that a scene may impose (stiffness level 30), the mean overlap is 0.11.
inline constexpr double kDeepestMean = 0.12;

/// Overlaps of all contacts whose surfaces touch, each divided by the smaller radius of its two grains.
struct Overlaps {
  double mean = 0.0;
  double largest = 0.0;
  double deep_share = 0.0;  ///< fraction of these contacts whose overlap is larger than kDeepOverlap
};

template <int Dim>
Overlaps measure_overlaps(const Packing<Dim>& packing);

/// Returns the largest solid fraction of equal hard grains: of the triangular lattice of disks or the
/// face-centred cubic lattice of spheres.
constexpr double densest_of_equal(int dim) {
  return dim == 2 ? 0.906899682117109 : 0.740480489693061;
}

/// Returns a warning, with the likely cause, if the grains of a packing overlap too far, or if its grains are
/// equal and denser than hard grains can be; otherwise empty. It is not an error, because soft packings may be
/// intended.
template <int Dim>
std::string overlap_warning(const Packing<Dim>& packing);

/// Returns a question for messages about large overlaps: "is K_N = 10 consistent with the units of lengths and
/// forces?".
std::string question_of_units(const Law& law);

/// Requires that overlaps are small if the contact law holds only for small overlaps.
/// @param place  place of the packing in messages
/// @throws InputError if the mean overlap is larger than kDeepestMean
template <int Dim>
void require_small_overlaps(const std::string& place, const Packing<Dim>& packing);

}  // namespace floc
