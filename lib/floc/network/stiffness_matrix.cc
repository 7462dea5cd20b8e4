#include "floc/network/stiffness_matrix.h"

#include <algorithm>
#include <vector>

#include "floc/base/huge_pages.h"
#include "floc/network/assembly.h"

namespace floc {
namespace {

/// K with the lower triangle of its grains in compressed columns. The columns of a grain hold its diagonal
/// block from the diagonal down, then a block for each neighbour.
template <int Dim>
class SymmetricSum {
 public:
  static constexpr bool kSymmetric = true;
  using Block = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

  SymmetricSum(const ContactNetwork<Dim>& network, int n_boundary)
      : graph_(contact_graph(network.n_grains, network.contacts)) {
    out_.grains.resize(network.n_unknowns(), network.n_unknowns());
    out_.border = Eigen::MatrixXd::Zero(network.n_unknowns(), n_boundary);
    out_.boundary = Eigen::MatrixXd::Zero(n_boundary, n_boundary);
    lay_out(network.n_grains);
  }

  /// @param block  rows of grain `low`, columns of grain `high`, low <= high; below the diagonal its transpose
  ///               is stored
  void add(int low, int high, const Block& block) {
    if (low == high) return add_diagonal(low, block);
    const auto first = graph_.neighbour.begin() + graph_.start[low];
    const auto place = std::find(first, graph_.neighbour.begin() + graph_.start[low + 1], high) - first;
    for (int b = 0; b < kDofs<Dim>; ++b) {
      double* column = column_of(low, b) + (kDofs<Dim> - b) + kDofs<Dim> * place;
      for (int a = 0; a < kDofs<Dim>; ++a) column[a] += block(b, a);
    }
  }
  auto border(int grain) { return out_.border.template middleRows<kDofs<Dim>>(first_unknown<Dim>(grain)); }
  Eigen::MatrixXd& boundary() { return out_.boundary; }

  StiffnessMatrix take() { return std::move(out_); }

 private:
  double* column_of(int grain, int b) {
    return out_.grains.valuePtr() + out_.grains.outerIndexPtr()[first_unknown<Dim>(grain) + b];
  }

  void add_diagonal(int grain, const Block& block) {
    for (int b = 0; b < kDofs<Dim>; ++b) {
      double* column = column_of(grain, b);
      for (int a = b; a < kDofs<Dim>; ++a) column[a - b] += block(a, b);
    }
  }

  void lay_out(int n_grains) {
    Eigen::SparseMatrix<double>& matrix = out_.grains;
    const int n_off = static_cast<int>(graph_.neighbour.size());
    matrix.resizeNonZeros(n_grains * (kDofs<Dim> * (kDofs<Dim> + 1) / 2) + n_off * kDofs<Dim> * kDofs<Dim>);
    prefer_huge_pages(matrix.valuePtr(), matrix.data().size() * sizeof(double));
    prefer_huge_pages(matrix.innerIndexPtr(), matrix.data().size() * sizeof(int));
    std::fill_n(matrix.valuePtr(), matrix.data().size(), 0.0);
    int at = 0;
    for (int g = 0; g < n_grains; ++g)
      for (int b = 0; b < kDofs<Dim>; ++b) {
        matrix.outerIndexPtr()[first_unknown<Dim>(g) + b] = at;
        for (int a = b; a < kDofs<Dim>; ++a) matrix.innerIndexPtr()[at++] = first_unknown<Dim>(g) + a;
        for (int k = graph_.start[g]; k < graph_.start[g + 1]; ++k)
          for (int a = 0; a < kDofs<Dim>; ++a)
            matrix.innerIndexPtr()[at++] = first_unknown<Dim>(graph_.neighbour[k]) + a;
      }
    matrix.outerIndexPtr()[kDofs<Dim> * n_grains] = at;
  }

  ContactGraph graph_;
  StiffnessMatrix out_;
};

}  // namespace

template <int Dim>
StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>& network, const StiffnessOptions& options) {
  const int n_boundary = n_strains<Dim>(options.strains);
  SymmetricSum<Dim> sum(network, n_boundary);
  const auto add = [&](const NetworkContact<Dim>& c, const ContactRows<Dim>& rows, const RowStiffness<Dim>& k) {
    add_contact(c.i, c.j, rows.on_i, rows.on_j, rows.on_strain.leftCols(n_boundary), k.asDiagonal(), sum);
  };
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> rows = contact_rows(c);
    add(c, rows, row_stiffness(c));
    if (options.prestress) add(c, translation_rows(rows), row_prestress(c));
  }
  return sum.take();
}

template <int Dim>
Eigen::MatrixXd affine_stiffness(const ContactNetwork<Dim>& network, StrainSet strains) {
  const int n_boundary = n_strains<Dim>(strains);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n_boundary, n_boundary);
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> rows = contact_rows(c);
    const auto g = rows.on_strain.leftCols(n_boundary);
    sum += g.transpose() * row_stiffness(c).asDiagonal() * g;
  }
  return sum;
}

Eigen::SparseMatrix<double> StiffnessMatrix::whole() const {
  const int n = static_cast<int>(grains.rows());
  const int m = static_cast<int>(boundary.rows());
  std::vector<Eigen::Triplet<double>> triplets;
  for (int c = 0; c < n; ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(grains, c); it; ++it) {
      const int row = static_cast<int>(it.row());
      triplets.emplace_back(row, c, it.value());
      if (row != c) triplets.emplace_back(c, row, it.value());
    }
  for (int b = 0; b < m; ++b) {
    for (int a = 0; a < n; ++a) {
      triplets.emplace_back(a, n + b, border(a, b));
      triplets.emplace_back(n + b, a, border(a, b));
    }
    for (int a = 0; a < m; ++a) triplets.emplace_back(n + a, n + b, boundary(a, b));
  }
  Eigen::SparseMatrix<double> matrix(n + m, n + m);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

template StiffnessMatrix stiffness_matrix(const ContactNetwork<2>&, const StiffnessOptions&);
template StiffnessMatrix stiffness_matrix(const ContactNetwork<3>&, const StiffnessOptions&);
template Eigen::MatrixXd affine_stiffness(const ContactNetwork<2>&, StrainSet);
template Eigen::MatrixXd affine_stiffness(const ContactNetwork<3>&, StrainSet);

}  // namespace floc
