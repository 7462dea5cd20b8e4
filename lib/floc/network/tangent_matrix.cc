#include "floc/network/tangent_matrix.h"

#include <algorithm>

#include "floc/network/geometric_stiffness.h"

namespace floc {

/// Blocks of the tangent matrix, in both triangles, in the form that add_contact() requires.
template <int Dim>
class TangentMatrix<Dim>::Sum {
 public:
  static constexpr bool kSymmetric = false;

  explicit Sum(TangentMatrix& matrix)
      : m_(matrix), values_(matrix.matrix_.valuePtr()), start_(matrix.matrix_.outerIndexPtr()) {}

  template <class Block>
  void add(int row, int column, const Block& block) {
    const auto first = m_.neighbour_.begin() + m_.start_[column];
    const auto place = std::find(first, m_.neighbour_.begin() + m_.start_[column + 1], row) - first;
    double* values = values_ + start_[first_unknown<Dim>(column)] + kDofs<Dim> * place;
    const int length = column_length(column);
    for (int b = 0; b < kDofs<Dim>; ++b)
      for (int a = 0; a < kDofs<Dim>; ++a) values[b * length + a] += block(a, b);
  }

  auto border(int grain) {
    const int order = static_cast<int>(m_.matrix_.rows());
    return strided(values_ + start_[order - m_.n_boundary_] + first_unknown<Dim>(grain), kDofs<Dim>,
                   m_.n_boundary_, order);
  }
  auto border_row(int grain) {
    const int length = column_length(grain);
    return strided(values_ + start_[first_unknown<Dim>(grain)] + length - m_.n_boundary_, m_.n_boundary_,
                   kDofs<Dim>, length);
  }
  auto boundary() {
    const int order = static_cast<int>(m_.matrix_.rows());
    const int first = order - m_.n_boundary_;
    return strided(values_ + start_[first] + first, m_.n_boundary_, m_.n_boundary_, order);
  }

 private:
  static auto strided(double* first, int rows, int columns, int stride) {
    constexpr int kMaxColumns = BoundaryColumns<Dim>::kMaxColumns;
    using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxColumns, kMaxColumns>;
    return Eigen::Map<Values, 0, Eigen::OuterStride<>>(first, rows, columns, Eigen::OuterStride<>(stride));
  }

  int column_length(int grain) const {
    const int column = first_unknown<Dim>(grain);
    return start_[column + 1] - start_[column];
  }

  TangentMatrix& m_;
  double* values_;
  const int* start_;
};

template <int Dim>
TangentMatrix<Dim>::TangentMatrix(std::vector<double> grain_size, const ContactGraph& graph, int n_boundary)
    : grain_size_(std::move(grain_size)), n_boundary_(n_boundary) {
  lay_out(graph);
}

template <int Dim>
void TangentMatrix<Dim>::lay_out(const ContactGraph& graph) {
  const int n = static_cast<int>(grain_size_.size());
  // Each grain is listed as a neighbour of itself, so that its diagonal block is included. Both triangles are stored,
  // because the tangent matrix is not symmetric.
  std::vector<std::vector<int>> neighbours(n);
  for (int g = 0; g < n; ++g) neighbours[g].push_back(g);
  for (int g = 0; g < n; ++g)
    for (int k = graph.start[g]; k < graph.start[g + 1]; ++k) {
      neighbours[g].push_back(graph.neighbour[k]);
      neighbours[graph.neighbour[k]].push_back(g);
    }
  start_.assign(1, 0);
  for (std::vector<int>& of : neighbours) {
    std::sort(of.begin(), of.end());
    neighbour_.insert(neighbour_.end(), of.begin(), of.end());
    start_.push_back(static_cast<int>(neighbour_.size()));
  }
  const int order = kDofs<Dim> * n + n_boundary_;
  matrix_.resize(order, order);
  matrix_.resizeNonZeros(kDofs<Dim> * (kDofs<Dim> * static_cast<int>(neighbour_.size()) + n * n_boundary_) +
                         n_boundary_ * order);
  // Row indices ascend in each column, as required for compressed storage. The blocks of a grain are stored in full,
  // including zeros, and the columns of the boundary contain all rows. The pattern of the matrix therefore does not
  // depend on the values of its entries.
  int at = 0;
  for (int column = 0; column < order; ++column) {
    matrix_.outerIndexPtr()[column] = at;
    const int grain = column / kDofs<Dim>;
    if (grain < n) {
      for (int k = start_[grain]; k < start_[grain + 1]; ++k)
        for (int a = 0; a < kDofs<Dim>; ++a)
          matrix_.innerIndexPtr()[at++] = first_unknown<Dim>(neighbour_[k]) + a;
      for (int row = kDofs<Dim> * n; row < order; ++row) matrix_.innerIndexPtr()[at++] = row;
    } else {
      for (int row = 0; row < order; ++row) matrix_.innerIndexPtr()[at++] = row;
    }
  }
  matrix_.outerIndexPtr()[order] = at;
  reset(0.0);
}

template <int Dim>
void TangentMatrix<Dim>::reset(double regularisation) {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  matrix_.diagonal().array() += regularisation;
}

template <int Dim>
void TangentMatrix<Dim>::add(const NetworkContact<Dim>& c, const ConsistentStiffness<Dim>& d,
                             const MotionMatrix<Dim>& geometric, const BoundaryColumns<Dim>& boundary) {
  constexpr int kRotationDofs = kRotations<Dim>;
  Sum sum(*this);
  const double size_i = grain_size_[c.i], size_j = grain_size_[c.j];
  const GrainMotions<Dim> of_grains = grain_motions(c, size_i, size_j);
  // A strain or a displacement of walls displaces the two grains of the contact relative to each other, but does not
  // rotate the grains.
  using OnBoundary = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMotionRows<Dim>,
                                   BoundaryColumns<Dim>::kMaxColumns>;
  OnBoundary moved = OnBoundary::Zero(kMotionRows<Dim>, n_boundary_);
  moved.template topRows<Dim>() = boundary.displacement;
  ContactRows<Dim> rows = contact_rows(c);
  OnBoundary felt = OnBoundary::Zero(kDofs<Dim>, n_boundary_);
  felt.row(0) = -c.frame.col(0).transpose() * boundary.displacement;
  for (int a = 1; a < Dim; ++a) felt.row(a) = c.frame.col(a).transpose() * boundary.displacement;
  rows.on_i.template rightCols<kRotationDofs>() /= size_i;
  rows.on_j.template rightCols<kRotationDofs>() /= size_j;
  add_contact(c.i, c.j, rows.on_i, rows.on_j, felt, d, sum);
  add_contact(c.i, c.j, of_grains.on_i, of_grains.on_j, moved, geometric, sum);
  sum.border_row(c.i) += boundary.follow * of_grains.on_i.template topRows<Dim>();
  sum.border_row(c.j) += boundary.follow * of_grains.on_j.template topRows<Dim>();
  sum.boundary() += boundary.follow * boundary.displacement;
}

template <int Dim>
void TangentMatrix<Dim>::add_boundary(const Eigen::Ref<const Eigen::MatrixXd>& block) {
  Sum(*this).boundary() += block;
}

template class TangentMatrix<2>;
template class TangentMatrix<3>;

}  // namespace floc
