#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "floc/lattice/lattice.h"

namespace floc {

struct IrregularLatticeOptions {
  double spacing = 0.0;  ///< spacing of the cubic grid whose points are displaced (length)
  /// Largest displacement of a grid point along each axis, divided by the spacing. With the default value, the lattice
  /// is isotropic and no two points are very close to each other.
  double jitter = 0.35;
  std::uint64_t seed = 1;  ///< seed of the random displacements of the grid points

  /// Returns every invalid option as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Returns a lattice in any periodic cell. The nodes are randomly displaced points of a cubic grid, joined by Delaunay
/// bonds (some 7.8 per point) and surrounded by Voronoi cells. The force of a bond acts at the centre of the face that
/// the Voronoi cells of its two points share.
/// @throws InputError if an option is invalid, or if more than 1e8 nodes would be needed
Lattice<3> irregular_lattice(const Cell<3>& cell, const IrregularLatticeOptions& options);

}  // namespace floc
