#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/lattice.h"
#include "floc/packing/packing.h"

namespace floc {

/// Material of a node of a lattice; `none` is void.
enum class Phase : std::uint8_t { none, grain, matrix };

struct CementOptions {
  double matrix_content = 0.0;  ///< rho_m: share of the volume that the matrix has to fill, 0 to 1
  /// Grains whose surfaces are closer than this (in mean diameters, >= 0) are joined by a bridge. Wider than
  /// the gaps of a frictionless packing's contacts, narrower than those to second neighbours.
  double bridge_gap = 0.05;

  static constexpr NumberRange kContent{.least = 0.0, .most = 1.0};
  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Grains and matrix laid on a lattice.
template <int Dim>
struct CementedSample {
  Lattice<Dim> lattice;
  Grains<Dim> grains;        ///< in the lattice's cell: centres moved with it, radii scaled with its volume
  std::vector<Phase> phase;  ///< material of each node
  /// Grain with the nearest surface, of each node that is not void; -1 of void nodes.
  std::vector<int> owner;
  /// Nearest image of that grain, at centre + owner_image * cell.matrix.
  std::vector<Vec<Dim, int>> owner_image;
  double grain_content = 0.0;   ///< rho_p, counted on the lattice
  double matrix_content = 0.0;  ///< rho_m, counted on the lattice
  /// Width of the bridges over R' = 2 R_i R_j/(R_i + R_j), the same for all.
  double bridge_width = 0.0;
  int n_bridges = 0;  ///< pairs of grains that are joined, with or without a node between them
  double mean_diameter = 0.0;
  double strain = 0.0;  ///< largest component of the strain that fitted the packing to the lattice
};

/// Lays a packing on a lattice. Nodes inside a grain become its own (where two grains overlap, those of the
/// grain in which they lie deeper). Straight bridges of width w R' between the centres of neighbours then
/// become matrix, with w raised until the matrix has its content; w is found by sorting the free nodes by the
/// smallest w that covers them.
/// @throws InputError with the faults of the options, if the packing has walls, or the matrix content cannot be
/// reached (the message gives the largest that can)
template <int Dim>
CementedSample<Dim> cement(const Packing<Dim>& packing, Lattice<Dim> lattice, const CementOptions& options);

}  // namespace floc
