#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/lattice/lattice_network.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {

/// Lattice network as springs between nodes with `Size` unknowns each. If all elements are central, Size = Dim, because
/// no rotations are needed; otherwise Size = kDofs<Dim>, with rotations multiplied by the spacing. Nodes without
/// elements have no unknowns.
template <int Dim, int Size>
struct SpringRows {
  using OnNode = Eigen::Matrix<double, Size, 1>;
  using OnStrain = Eigen::Matrix<double, kSymmetric<Dim>, 1>;
  /// Row of a spring: coefficients of the unknowns of its two nodes in its elongation. The first row of an element
  /// gives its overlap instead, with shortening positive.
  struct Row {
    int i, j;           // indices of the two nodes in `node`
    OnNode on_i, on_j;  // zero for fixed displacements; if i = j, `on_i` contains both
    double stiffness;
  };

  std::vector<Row> rows;
  /// Coefficients of the strains in each row, in the order of StrainSet::full.
  std::vector<OnStrain> on_strain;
  std::vector<int> element;    ///< number of the element to which each row belongs
  std::vector<int> one_sided;  ///< rows of unilateral elements, ascending
  std::vector<int> first_row;  ///< first row of each element, then the number of rows
  std::vector<int> node;       ///< number in the lattice of each node with unknowns
  int n_unknowns() const { return Size * static_cast<int>(node.size()); }
};

/// Returns the springs of a lattice network.
template <int Dim, int Size>
SpringRows<Dim, Size> spring_rows(const LatticeNetwork<Dim>& network);

}  // namespace floc
