#pragma once

#include <algorithm>
#include <utility>

#include "floc/base/huge_pages.h"
#include "floc/network/contact_blocks.h"
#include "floc/network/stiffness_matrix.h"

namespace floc {

/// Stiffness matrix of bodies that have `Size` unknowns each. Contacts are added one after another by add_contact().
/// The matrix has a block for the bodies and blocks for the boundary. In the block for the bodies, only the lower
/// triangle is stored, in compressed columns. The columns of a body contain its diagonal block, from the diagonal down,
/// then one block for each neighbour with a higher number. Zeros are also stored, so that the pattern of the matrix
/// does not depend on the stiffnesses.
template <int Size>
class SymmetricSum {
 public:
  static constexpr bool kSymmetric = true;
  using Block = Eigen::Matrix<double, Size, Size>;

  /// @param contacts  range of objects with the numbers i and j of two bodies
  template <class Contacts>
  SymmetricSum(int n_grains, const Contacts& contacts, int n_boundary)
      : graph_(contact_graph(n_grains, contacts)) {
    out_.grains.resize(Size * n_grains, Size * n_grains);
    out_.border = Eigen::MatrixXd::Zero(Size * n_grains, n_boundary);
    out_.boundary = Eigen::MatrixXd::Zero(n_boundary, n_boundary);
    lay_out(n_grains);
  }

  /// Adds a block for a pair of bodies, low <= high.
  /// @param block  rows of body `low`, columns of body `high`; its transpose is stored below the diagonal
  void add(int low, int high, const Block& block) {
    if (low == high) return add_diagonal(low, block);
    const auto first = graph_.neighbour.begin() + graph_.start[low];
    const auto place = std::find(first, graph_.neighbour.begin() + graph_.start[low + 1], high) - first;
    for (int b = 0; b < Size; ++b) {
      double* column = column_of(low, b) + (Size - b) + Size * place;
      for (int a = 0; a < Size; ++a) column[a] += block(b, a);
    }
  }
  auto border(int grain) { return out_.border.template middleRows<Size>(Size * grain); }
  Eigen::MatrixXd& boundary() { return out_.boundary; }

  StiffnessMatrix take() { return std::move(out_); }

 private:
  double* column_of(int grain, int b) {
    return out_.grains.valuePtr() + out_.grains.outerIndexPtr()[Size * grain + b];
  }

  void add_diagonal(int grain, const Block& block) {
    for (int b = 0; b < Size; ++b) {
      double* column = column_of(grain, b);
      for (int a = b; a < Size; ++a) column[a - b] += block(a, b);
    }
  }

  void lay_out(int n_grains) {
    Eigen::SparseMatrix<double>& matrix = out_.grains;
    const int n_off = static_cast<int>(graph_.neighbour.size());
    matrix.resizeNonZeros(n_grains * (Size * (Size + 1) / 2) + n_off * Size * Size);
    prefer_huge_pages(matrix.valuePtr(), matrix.data().size() * sizeof(double));
    prefer_huge_pages(matrix.innerIndexPtr(), matrix.data().size() * sizeof(int));
    std::fill_n(matrix.valuePtr(), matrix.data().size(), 0.0);
    int at = 0;
    for (int g = 0; g < n_grains; ++g)
      for (int b = 0; b < Size; ++b) {
        matrix.outerIndexPtr()[Size * g + b] = at;
        for (int a = b; a < Size; ++a) matrix.innerIndexPtr()[at++] = Size * g + a;
        for (int k = graph_.start[g]; k < graph_.start[g + 1]; ++k)
          for (int a = 0; a < Size; ++a) matrix.innerIndexPtr()[at++] = Size * graph_.neighbour[k] + a;
      }
    matrix.outerIndexPtr()[Size * n_grains] = at;
  }

  ContactGraph graph_;
  StiffnessMatrix out_;
};

}  // namespace floc
