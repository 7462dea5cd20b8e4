#pragma once

#include <optional>
#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// Solid fraction in two boxes about the centre of the cell: in a cube, and in a shrunk copy of the cell. Along an axis
/// with walls, the boxes lie in the middle between the walls. The volumes of grains inside the boxes are exact; the
/// volume of an overlap counts once for each of its two grains, as in solid_fraction().
struct PorosityProbe {
  /// Half the side of the cube, divided by the shortest distance between opposite faces of the cell. The shrunk cell of
  /// `in_cell` is the cell, scaled about its centre by the factor 2 half_side.
  double half_side = 0.0;
  double in_cube = 0.0;           ///< solid fraction in the cube
  std::optional<double> in_cell;  ///< solid fraction in the shrunk cell; absent if the cell is not rectangular
};

inline constexpr WholeRange kPorosityProbes{.least = 1, .most = 10000};

/// Returns the solid fractions in boxes with half_side = 1/(2 n), 2/(2 n) ... 1/2. The largest shrunk cell is the whole
/// cell.
/// @param n  number of cubes, and of shrunk cells
/// @throws InputError if n is not in kPorosityProbes
template <int Dim>
std::vector<PorosityProbe> porosity_probes(const Packing<Dim>& packing, int n);

}  // namespace floc
