#pragma once

#include <optional>
#include <vector>

#include "floc/base/range.h"
#include "floc/packing/packing.h"

namespace floc {

/// Solid fraction in boxes about the centre of the cell (between walls, of the space between them). The volumes
/// that a box and the grains share are exact; overlaps count for each grain, as in solid_fraction().
struct PorosityProbe {
  /// Half the side of a cube, over the shortest distance L between opposite faces of the cell; for the cell
  /// shrunk about its centre, half the factor of shrinking.
  double half_side = 0.0;
  double in_cube = 0.0;           ///< solid fraction in the cube
  std::optional<double> in_cell;  ///< solid fraction in the shrunk cell; absent if the cell is not right-angled
};

inline constexpr WholeRange kPorosityProbes{.least = 1, .most = 10000};

/// Returns probes of half sides 1/(2 n), 2/(2 n) ... 1/2, in L. The largest shrunk cell is the cell itself.
/// @param n  number of probes   @throws InputError if it is not in kPorosityProbes
template <int Dim>
std::vector<PorosityProbe> porosity_probes(const Packing<Dim>& packing, int n);

}  // namespace floc
