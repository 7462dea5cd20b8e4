#pragma once

#include <vector>

#include "floc/base/vec.h"
#include "floc/geometry/cell.h"

namespace floc {

/// Bond between two neighbouring nodes of a lattice.
template <int Dim>
struct LatticeBond {
  int i;                ///< first node
  int j;                ///< second node; equal to the first node if the lattice is one node wide
  Vec<Dim, int> image;  ///< periodic image of node j: branch = node[j] + image * cell.matrix - node[i]
  Vec<Dim> branch;      ///< vector from node i to the image of node j (length)
  Vec<Dim> arm_i;       ///< vector from node i to the point at which the force of the bond acts (length)
  double facet;         ///< length (2D) or area (3D) of the face between the cells around the two nodes
};

/// Lattice of nodes that fill a periodic cell, and the bonds between neighbouring nodes, each bond once.
template <int Dim>
struct Lattice {
  Cell<Dim> cell;
  /// Distance between neighbouring nodes (length). For an irregular lattice: the distance in a regular lattice of the
  /// same density.
  double spacing = 0.0;
  std::vector<Vec<Dim>> node;  ///< positions of the nodes, inside the cell (length)
  /// volume (2D: area) of the cell around each node; the sum of these volumes is the volume of the periodic cell
  std::vector<double> volume;
  std::vector<LatticeBond<Dim>> bonds;

  int n_nodes() const { return static_cast<int>(node.size()); }
};

/// Returns the triangular lattice whose rows of nodes lie along the first axis. Each node has six bonds, which are as
/// long as the spacing, and a hexagonal cell of area sqrt(3)/2 spacing^2. The force of a bond acts at the middle of the
/// bond.
/// @param columns  number of nodes in a row, >= 1
/// @param rows     number of rows, even, >= 2; neighbouring rows are sqrt(3)/2 spacing apart
/// @param spacing  distance between neighbouring nodes (length)
Lattice<2> triangular_lattice(int columns, int rows, double spacing);

/// Returns the triangular lattice that fits best into a rectangular cell. The number of columns is within 3 % of the
/// cell's width divided by the spacing. The lattice has the area of the cell. The ratio of its sides is as close as
/// possible to the ratio of the sides of the cell. The sides of the lattice and of the cell differ by a fraction of
/// some 1e-4. To fit the lattice, a packing in the cell has to be deformed by this strain. The lattice vectors have the
/// signs of those of the cell.
/// @throws InputError if the cell is not rectangular, or if more than 1e8 nodes would be needed
Lattice<2> triangular_lattice_in(const Cell<2>& cell, double spacing);

}  // namespace floc
