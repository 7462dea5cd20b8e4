#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/lattice.h"
#include "floc/packing/packing.h"

namespace floc {

/// Material of a node of a lattice; `none` is a void.
enum class Phase : std::uint8_t { none, grain, matrix };

struct CementOptions {
  double matrix_content =
      0.0;  ///< matrix content rho_m: share of the volume that the matrix has to fill, 0 to 1
  /// Largest gap between the surfaces of two grains that are joined by a bridge of matrix, in mean diameters, >= 0. The
  /// default is wider than the gaps of contacts in a frictionless packing and narrower than the gaps to second
  /// neighbours.
  double bridge_gap = 0.05;

  static constexpr NumberRange kContent{.least = 0.0, .most = 1.0};
  /// Returns every invalid option as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Sample of grains cemented by a matrix, mapped to the nodes of a lattice.
template <int Dim>
struct CementedSample {
  Lattice<Dim> lattice;
  Grains<Dim>
      grains;  ///< grains in the cell of the lattice: the centres follow its strain, the radii its volume
  std::vector<Phase> phase;  ///< material of each node
  /// For each node, the grain with the nearest surface; -1 for void nodes.
  std::vector<int> owner;
  /// For each node, the image of its owner whose surface is nearest, with its centre at centre + owner_image *
  /// cell.matrix.
  std::vector<Vec<Dim, int>> owner_image;
  double grain_content = 0.0;   ///< grain content rho_p: share of the volume of all nodes that are grains
  double matrix_content = 0.0;  ///< matrix content rho_m: share of the volume of all nodes that are matrix
  /// Width of the bridges over R' = 2 R_i R_j/(R_i + R_j), with the radii R of the two grains; equal for all bridges.
  double bridge_width = 0.0;
  int n_bridges =
      0;  ///< number of pairs of grains that are joined by a bridge, with or without a node between them
  double mean_diameter = 0.0;  ///< mean diameter of the grains (length)
  double strain = 0.0;  ///< largest component of the strain by which the packing was fitted to the lattice
};

/// Maps a packing to the nodes of a lattice and adds the matrix. A node inside a grain belongs to this grain; if two
/// grains overlap, it belongs to the grain in which it lies deeper. Straight bridges of width w R' between the centres
/// of neighbouring grains then become matrix. The width w is increased until the matrix has the wanted content; it is
/// found by sorting the free nodes by the smallest w that covers them.
/// @throws InputError if an option is invalid, the packing has walls, or the matrix content cannot be reached (the
///         message gives the largest possible content)
template <int Dim>
CementedSample<Dim> cement(const Packing<Dim>& packing, Lattice<Dim> lattice, const CementOptions& options);

}  // namespace floc
