#pragma once

#include <string>

#include "floc/packing/packing.h"

namespace floc {

/// Largest overlap, divided by the smaller radius of the two grains, at which contact laws are valid. At larger
/// overlaps the radius of the contact circle between spheres exceeds a third of the radius of the spheres, and the
/// contacts of a grain affect each other.
inline constexpr double kDeepOverlap = 0.1;
/// Largest accepted mean overlap, divided by the smaller radius of the two grains. A packing with a larger mean overlap
/// is rejected. Scene files may impose pressures P for which (E~/P)^(2/3) is at least 30, with E~ = E/(1 - nu^2),
/// Young's modulus E and Poisson's ratio nu. At the largest of these pressures, the mean overlap is 0.11.
inline constexpr double kDeepestMean = 0.12;

/// Statistics of the overlaps of all contacts whose surfaces touch. Each overlap is divided by the smaller radius of
/// the two grains.
struct Overlaps {
  double mean = 0.0;
  double largest = 0.0;
  double deep_share = 0.0;  ///< fraction of the contacts whose overlap is larger than kDeepOverlap
};

template <int Dim>
Overlaps measure_overlaps(const Packing<Dim>& packing);

/// Returns the largest possible solid fraction of equal hard grains: that of the triangular lattice of disks (2D) or of
/// the face-centred cubic lattice of spheres (3D).
constexpr double densest_of_equal(int dim) {
  return dim == 2 ? 0.906899682117109 : 0.740480489693061;
}

/// Returns a warning, with the likely cause, if the grains of a packing overlap too far, or if all grains are equal and
/// the solid fraction is larger than is possible for hard grains. Otherwise returns an empty text. Large overlaps are
/// not an error, because a soft packing may be intended.
template <int Dim>
std::string overlap_warning(const Packing<Dim>& packing);

/// Returns a question about units, for messages about large overlaps: "is K_N = 10 consistent with the units of lengths
/// and forces?".
std::string question_of_units(const Law& law);

/// Requires small overlaps in a packing whose contact law is valid only for small overlaps. Packings with other laws
/// are accepted without a check.
/// @param place  name of the packing in messages, such as its file
/// @throws InputError if the mean overlap is larger than kDeepestMean
template <int Dim>
void require_small_overlaps(const std::string& place, const Packing<Dim>& packing);

}  // namespace floc
