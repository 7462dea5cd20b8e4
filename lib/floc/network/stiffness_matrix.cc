#include "floc/network/stiffness_matrix.h"

#include <algorithm>
#include <vector>

#include "floc/base/huge_pages.h"

namespace floc {
namespace {

/// Neighbours of each grain with a higher number, each once, in ascending order: the blocks below the diagonal.
struct ContactGraph {
  std::vector<int> start;  // of each grain in `neighbour`, and the end
  std::vector<int> neighbour;
};

template <int Dim>
ContactGraph contact_graph(const ContactNetwork<Dim>& network) {
  ContactGraph graph;
  graph.start.assign(network.n_grains + 1, 0);
  for (const NetworkContact<Dim>& c : network.contacts)
    if (c.i != c.j) ++graph.start[std::min(c.i, c.j) + 1];
  for (int g = 0; g < network.n_grains; ++g) graph.start[g + 1] += graph.start[g];
  graph.neighbour.resize(graph.start.back());
  std::vector<int> next(graph.start.begin(), graph.start.end() - 1);
  for (const NetworkContact<Dim>& c : network.contacts)
    if (c.i != c.j) graph.neighbour[next[std::min(c.i, c.j)]++] = std::max(c.i, c.j);
  int kept = 0;  // several contacts of one pair share a block
  for (int g = 0; g < network.n_grains; ++g) {
    const auto first = graph.neighbour.begin() + graph.start[g];
    const auto last = graph.neighbour.begin() + graph.start[g + 1];
    std::sort(first, last);
    graph.start[g] = kept;
    kept = static_cast<int>(std::unique_copy(first, last, graph.neighbour.begin() + kept) -
                            graph.neighbour.begin());
  }
  graph.start.back() = kept;
  graph.neighbour.resize(kept);
  return graph;
}

/// Adds blocks of kDofs x kDofs to the lower triangle of a matrix in compressed columns. The columns of a grain
/// hold its diagonal block from the diagonal down, then a block for each neighbour.
template <int Dim>
class LowerBlocks {
 public:
  using Block = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

  LowerBlocks(const ContactGraph& graph, int n_grains)
      : graph_(graph), matrix_(kDofs<Dim> * n_grains, kDofs<Dim> * n_grains) {
    lay_out(n_grains);
  }

  void add_diagonal(int grain, const Block& block) {
    for (int b = 0; b < kDofs<Dim>; ++b) {
      double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[first_unknown<Dim>(grain) + b];
      for (int a = b; a < kDofs<Dim>; ++a) column[a - b] += block(a, b);
    }
  }

  /// @param block  rows of grain `low`, columns of grain `high`, low < high; its transpose is stored
  void add_pair(int low, int high, const Block& block) {
    const auto first = graph_.neighbour.begin() + graph_.start[low];
    const auto place = std::find(first, graph_.neighbour.begin() + graph_.start[low + 1], high) - first;
    for (int b = 0; b < kDofs<Dim>; ++b) {
      double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[first_unknown<Dim>(low) + b] +
                       (kDofs<Dim> - b) + kDofs<Dim> * place;
      for (int a = 0; a < kDofs<Dim>; ++a) column[a] += block(b, a);
    }
  }

  Eigen::SparseMatrix<double> take() { return std::move(matrix_); }

 private:
  void lay_out(int n_grains) {
    const int n_off = static_cast<int>(graph_.neighbour.size());
    matrix_.resizeNonZeros(n_grains * (kDofs<Dim> * (kDofs<Dim> + 1) / 2) + n_off * kDofs<Dim> * kDofs<Dim>);
    prefer_huge_pages(matrix_.valuePtr(), matrix_.data().size() * sizeof(double));
    prefer_huge_pages(matrix_.innerIndexPtr(), matrix_.data().size() * sizeof(int));
    std::fill_n(matrix_.valuePtr(), matrix_.data().size(), 0.0);
    int at = 0;
    for (int g = 0; g < n_grains; ++g)
      for (int b = 0; b < kDofs<Dim>; ++b) {
        matrix_.outerIndexPtr()[first_unknown<Dim>(g) + b] = at;
        for (int a = b; a < kDofs<Dim>; ++a) matrix_.innerIndexPtr()[at++] = first_unknown<Dim>(g) + a;
        for (int k = graph_.start[g]; k < graph_.start[g + 1]; ++k)
          for (int a = 0; a < kDofs<Dim>; ++a)
            matrix_.innerIndexPtr()[at++] = first_unknown<Dim>(graph_.neighbour[k]) + a;
      }
    matrix_.outerIndexPtr()[kDofs<Dim> * n_grains] = at;
  }

  const ContactGraph& graph_;
  Eigen::SparseMatrix<double> matrix_;
};

template <int Dim>
void add_rows(const NetworkContact<Dim>& c, const ContactRows<Dim>& g, const RowStiffness<Dim>& k,
              LowerBlocks<Dim>& blocks, StiffnessMatrix& out) {
  using Block = typename LowerBlocks<Dim>::Block;
  const Block k_i = k.asDiagonal() * g.on_i;
  const auto strain_rows = g.on_strain.leftCols(out.boundary.cols());
  blocks.add_diagonal(c.i, g.on_i.transpose() * k_i);
  out.border.middleRows<kDofs<Dim>>(first_unknown<Dim>(c.i)) += k_i.transpose() * strain_rows;
  out.boundary += strain_rows.transpose() * k.asDiagonal() * strain_rows;
  if (c.i == c.j) return;
  const Block k_j = k.asDiagonal() * g.on_j;
  blocks.add_diagonal(c.j, g.on_j.transpose() * k_j);
  if (c.i < c.j)
    blocks.add_pair(c.i, c.j, g.on_i.transpose() * k_j);
  else
    blocks.add_pair(c.j, c.i, g.on_j.transpose() * k_i);
  out.border.middleRows<kDofs<Dim>>(first_unknown<Dim>(c.j)) += k_j.transpose() * strain_rows;
}

}  // namespace

template <int Dim>
StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>& network, const StiffnessOptions& options) {
  const int n_boundary = n_strains<Dim>(options.strains);
  StiffnessMatrix out;
  out.border = Eigen::MatrixXd::Zero(network.n_unknowns(), n_boundary);
  out.boundary = Eigen::MatrixXd::Zero(n_boundary, n_boundary);
  const ContactGraph graph = contact_graph(network);
  LowerBlocks<Dim> blocks(graph, network.n_grains);
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> rows = contact_rows(c);
    add_rows<Dim>(c, rows, row_stiffness(c), blocks, out);
    if (options.prestress) add_rows<Dim>(c, translation_rows(rows), row_prestress(c), blocks, out);
  }
  out.grains = blocks.take();
  return out;
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
