#pragma once

#include <vector>

#include "floc/base/vec.h"
#include "floc/geometry/cell.h"

namespace floc {

/// Two neighbouring nodes of a lattice.
template <int Dim>
struct LatticeBond {
  int i;
  int j;                ///< may equal i in a lattice of one node across
  Vec<Dim, int> image;  ///< branch = node[j] + image * cell.matrix - node[i]
  Vec<Dim> branch;      ///< from i to the image of j (length)
  Vec<Dim> arm_i;       ///< from i to the point at which the force of the bond acts (length)
  double facet;         ///< length (2D) or area (3D) of the face that the cells of the two nodes share
};

/// Nodes that fill a periodic cell and the bonds between neighbours, each bond once.
template <int Dim>
struct Lattice {
  Cell<Dim> cell;
  /// Distance of neighbours; where it varies, that in a regular lattice of equal density (length).
  double spacing = 0.0;
  std::vector<Vec<Dim>> node;  ///< inside the cell
  std::vector<double> volume;  ///< volume of the cell of each node; the sum is that of the periodic cell
  std::vector<LatticeBond<Dim>> bonds;

  int n_nodes() const { return static_cast<int>(node.size()); }
};

/// Returns the triangular lattice with rows of nodes along the first axis. Each node has six bonds as long as
/// the spacing, whose forces act at their middles, and a hexagonal cell of area sqrt(3)/2 spacing^2.
/// @param columns  nodes in a row, >= 1   @param rows  even, >= 2, sqrt(3)/2 spacing apart
Lattice<2> triangular_lattice(int columns, int rows, double spacing);

/// Returns the triangular lattice that comes closest to a rectangular cell. Its number of columns is within 3 %
/// of the cell's width over the spacing, and chosen with that of rows so that the ratio of its sides is nearest
/// to the cell's. It has the cell's area, and its sides differ from the cell's by some 1e-4; a packing laid on
/// it is strained by as much.
/// @throws InputError if the cell is not rectangular, or more than 1e8 nodes would be needed
Lattice<2> triangular_lattice_in(const Cell<2>& cell, double spacing);

}  // namespace floc
