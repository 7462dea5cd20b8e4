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
  /// How the two ends of a spring act on it: in an element's first row on the overlap, shortening positive.
  struct Row {
    int i, j;           // nodes here
    OnNode on_i, on_j;  // zero for what is held; with i = j, `on_i` has both
    double stiffness;
  };

  std::vector<Row> rows;
  std::vector<OnStrain> on_strain;  ///< of each row, in the order of StrainSet::full
  std::vector<int> element;         ///< of each row
  std::vector<int> one_sided;       ///< rows of unilateral elements, ascending
  std::vector<int> first_row;       ///< of each element, and the end
  std::vector<int> node;            ///< of the lattice, for each node here
  int n_unknowns() const { return Size * static_cast<int>(node.size()); }
};

template <int Dim, int Size>
SpringRows<Dim, Size> spring_rows(const LatticeNetwork<Dim>& network);

}  // namespace floc
