#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/lattice/lattice_network.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {

/// Lattice network as a list of springs between nodes. Each node that has an element has `Size` unknowns. If all
/// elements are central springs, no rotations are needed, and Size is Dim. Otherwise Size is kDofs<Dim>, and rotations
/// are multiplied by the spacing.
template <int Dim, int Size>
struct SpringRows {
  using OnNode = Eigen::Matrix<double, Size, 1>;
  using OnStrain = Eigen::Matrix<double, kSymmetric<Dim>, 1>;
  /// Spring, described by the coefficients of its elongation, which is a linear function of the unknowns of the two
  /// nodes. The first spring of an element lies along the element. Its coefficients give the overlap (positive in
  /// compression) instead of the elongation.
  struct Row {
    int i, j;  // indices of the two nodes in SpringRows::node
    // coefficients for node i and node j, zero for fixed displacements; if i = j, `on_i` contains both
    OnNode on_i, on_j;
    double stiffness;
  };

  std::vector<Row> rows;
  /// For each spring, the derivatives of its elongation with respect to the strains, in the order of StrainSet::full.
  std::vector<OnStrain> on_strain;
  std::vector<int> element;    ///< for each spring, the number of its element
  std::vector<int> one_sided;  ///< numbers of the springs of unilateral elements, ascending
  std::vector<int> first_row;  ///< number of the first spring of each element; last entry: number of springs
  std::vector<int> node;       ///< for each node with unknowns, its number in the lattice
  int n_unknowns() const { return Size * static_cast<int>(node.size()); }
};

/// Returns the springs of a lattice network.
template <int Dim, int Size>
SpringRows<Dim, Size> spring_rows(const LatticeNetwork<Dim>& network);

}  // namespace floc
