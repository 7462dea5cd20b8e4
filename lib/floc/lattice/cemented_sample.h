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
  /// matrix content rho_m: share of the volume that the matrix has to fill, 0 to 1
  double matrix_content = 0.0;
  /// Largest gap between two grains that a bridge of matrix joins, divided by the mean diameter, >= 0. In a
  /// frictionless packing, the default is wider than the gaps between nearest neighbours and narrower than the gaps
  /// between second neighbours.
  double bridge_gap = 0.05;

  static constexpr NumberRange kContent{.least = 0.0, .most = 1.0};
  /// Returns every invalid option as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Sample of grains cemented by a matrix. Each node of a lattice has the material that lies at its position.
template <int Dim>
struct CementedSample {
  Lattice<Dim> lattice;
  Grains<Dim>
      /// grains of the packing, after the strain that fits the packing to the cell of the lattice
      grains;
  std::vector<Phase> phase;  ///< material of each node
  /// For each node, its owner: the grain whose surface is nearest to it; -1 for void nodes.
  std::vector<int> owner;
  /// For each node, the periodic image of its owner that is nearest to the node. The centre of this image is the centre
  /// of the owner + owner_image * cell.matrix.
  std::vector<Vec<Dim, int>> owner_image;
  double grain_content = 0.0;  ///< grain content rho_p: share of the volume of all nodes that belongs to grains
  /// matrix content rho_m: share of the volume of all nodes that belongs to the matrix
  double matrix_content = 0.0;
  /// Width of a bridge divided by R' = 2 R_i R_j/(R_i + R_j), where R_i and R_j are the radii of its two grains. All
  /// bridges have the same ratio.
  double bridge_width = 0.0;
  /// number of pairs of grains that a bridge joins, including bridges that contain no node
  int n_bridges = 0;
  double mean_diameter = 0.0;  ///< mean diameter of the grains (length)
  double strain = 0.0;  ///< largest component of the strain by which the packing was fitted to the lattice
};

/// Gives each node of a lattice the material that a packing has at the position of the node, and adds the matrix:
/// 1. A node inside a grain belongs to this grain. A node inside two overlapping grains belongs to the grain in which
/// it lies deepest.
/// 2. Straight bridges between the centres of neighbouring grains are filled with matrix. A bridge between grains of
///    the radii R_i and R_j has the width w R', with R' = 2 R_i R_j/(R_i + R_j). The number w is chosen to give the
///    matrix the wanted content. To find w, the nodes outside grains are sorted by the smallest w at which a bridge
///    covers them.
///
/// @throws InputError if an option is invalid, the packing has walls, or the matrix content cannot be reached (the
///         message gives the largest possible content)
template <int Dim>
CementedSample<Dim> cement(const Packing<Dim>& packing, Lattice<Dim> lattice, const CementOptions& options);

}  // namespace floc
