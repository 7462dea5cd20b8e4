#pragma once

#include <optional>
#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// Solid fractions in two boxes around the centre of the cell: a cube, and a smaller copy of the cell. Along an axis
/// with walls, the boxes lie in the middle between the walls. The volumes of grains inside the boxes are exact. The
/// volume of an overlap counts twice, once for each of the two grains, as in solid_fraction().
struct PorosityProbe {
  /// Half the side of the cube, divided by the shortest distance between opposite faces of the cell. The sides of the
  /// smaller copy are the sides of the cell times 2 half_side.
  double half_side = 0.0;
  double in_cube = 0.0;  ///< solid fraction in the cube
  /// solid fraction in the smaller copy of the cell; absent if the cell is not rectangular
  std::optional<double> in_cell;
};

inline constexpr WholeRange kPorosityProbes{.least = 1, .most = 10000};

/// Returns the solid fractions in boxes with half_side = 1/(2 n), 2/(2 n) ... 1/2. The largest of the copies is the
/// cell itself.
/// @param n  number of values of half_side
/// @throws InputError if n is not in kPorosityProbes
template <int Dim>
std::vector<PorosityProbe> porosity_probes(const Packing<Dim>& packing, int n);

}  // namespace floc
