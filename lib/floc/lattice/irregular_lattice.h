#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/lattice/lattice.h"

namespace floc {

struct IrregularLatticeOptions {
  double spacing = 0.0;  ///< spacing of the regular points, one per cube of that side (length)
  /// Largest displacement of each coordinate of a point, in spacings: large enough that no direction is
  /// preferred, small enough that points stay apart.
  double jitter = 0.35;
  std::uint64_t seed = 1;

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Makes a lattice of points on a cubic grid, displaced at random, in any periodic cell, with their Delaunay
/// bonds, some 7.8 per point, and their Voronoi cells. Forces act at the centres of the faces between cells.
/// @throws InputError with the faults of the options, or if more than 1e8 nodes would be needed
Lattice<3> irregular_lattice(const Cell<3>& cell, const IrregularLatticeOptions& options);

}  // namespace floc
