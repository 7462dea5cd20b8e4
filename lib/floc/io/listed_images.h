#pragma once

#include "floc/io/file_line.h"
#include "floc/packing/packing.h"

/// Periodic images of listed grains.
namespace floc {

/// Largest distance of a periodic image from the cell, in numbers of cells. An int may be too small for larger numbers.
constexpr double kFarthestImage = 1e9;

/// Converts a displacement along the lattice vectors, in numbers of cells, from real numbers to integers.
/// @throws InputError naming `place` if a number exceeds kFarthestImage
template <int Dim>
Vec<Dim, int> whole_cells(const FileLine& place, const Vec<Dim>& cells);

/// Returns the smallest distance (length) between two opposite faces of the cell across a periodic axis; infinity if no
/// axis is periodic.
template <int Dim>
double smallest_width(const Packing<Dim>& packing);

/// Returns the periodic image of grain j that is nearest to grain i, in numbers of cells. In an extremely skewed cell,
/// the function may miss the nearest image; the caller should reduce such a cell first.
/// @param place  place of grain j, for messages
/// @throws InputError naming `place` if the grains are too many cells apart
template <int Dim>
Vec<Dim, int> nearest_image(const Packing<Dim>& packing, const FileLine& place, int i, int j);

}  // namespace floc
