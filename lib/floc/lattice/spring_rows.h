#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/lattice/lattice_network.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {

/// A lattice network as springs between nodes of `Size` unknowns each: Dim where all elements are central,
/// which need no rotations, otherwise kDofs<Dim>, with rotations multiplied by the spacing. Nodes without
/// elements have no unknowns.
template <int Dim, int Size>
struct SpringRows {
  using OnNode = Eigen::Matrix<double, Size, 1>;
  using OnStrain = Eigen::Matrix<double, kSymmetric<Dim>, 1>;
  /// Coefficients of the unknowns of both ends in the elongation of a spring; in the first row of an element,
  /// in the overlap, with shortening positive.
  struct Row {
    int i, j;           // indices in `node`
    OnNode on_i, on_j;  // zero for displacements that are held; with i = j, `on_i` has both
    double stiffness;
  };

  std::vector<Row> rows;
  /// Coefficients of the strains in each row, in the order of StrainSet::full.
  std::vector<OnStrain> on_strain;
  std::vector<int> element;    ///< element of each row
  std::vector<int> one_sided;  ///< rows of unilateral elements, ascending
  std::vector<int> first_row;  ///< first row of each element, and the end
  std::vector<int> node;       ///< node of the lattice of each node with unknowns
  int n_unknowns() const { return Size * static_cast<int>(node.size()); }
};

template <int Dim, int Size>
SpringRows<Dim, Size> spring_rows(const LatticeNetwork<Dim>& network);

}  // namespace floc
