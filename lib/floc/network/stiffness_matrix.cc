#include "floc/network/stiffness_matrix.h"

#include <array>

namespace floc {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Index pairs of the shear unknowns in the order of Voigt: 23, 13, 12 in 3D, 12 in 2D.
template <int Dim>
constexpr std::array<int, 2> shear_pair(int shear) {
  if constexpr (Dim == 2) return {0, 1};
  constexpr std::array<std::array<int, 2>, 3> kPairs{{{1, 2}, {0, 2}, {0, 1}}};
  return kPairs[shear];
}

template <int Dim>
using Block = Eigen::Matrix<double, kDofs<Dim>, kDofs<Dim>>;

/// Rows of the relative translation alone, rotations left out, as the prestress feels them.
template <int Dim>
ContactRows<Dim> translation_rows(ContactRows<Dim> rows) {
  rows.on_i.template rightCols<kRotations<Dim>>().setZero();
  rows.on_j.template rightCols<kRotations<Dim>>().setZero();
  rows.on_i.template bottomRows<kRotations<Dim>>().setZero();
  rows.on_j.template bottomRows<kRotations<Dim>>().setZero();
  return rows;
}

/// Geometric stiffness of each row: -F_N/r along the tangents.
template <int Dim>
Eigen::Matrix<double, kDofs<Dim>, 1> row_prestress(const NetworkContact<Dim>& c) {
  Eigen::Matrix<double, kDofs<Dim>, 1> k = Eigen::Matrix<double, kDofs<Dim>, 1>::Zero();
  k.template segment<Dim - 1>(1).setConstant(-c.normal_force / c.branch.norm());
  return k;
}

void add_block(Triplets& triplets, int row, int col, const auto& block) {
  for (int a = 0; a < block.rows(); ++a)
    for (int b = 0; b < block.cols(); ++b)
      if (row + a >= col + b) triplets.emplace_back(row + a, col + b, block(a, b));
}

template <int Dim>
void add_rows(const NetworkContact<Dim>& c, const ContactRows<Dim>& g,
              const Eigen::Matrix<double, kDofs<Dim>, 1>& k, Triplets& triplets, StiffnessMatrix& out) {
  const int i = first_unknown<Dim>(c.i);
  const int j = first_unknown<Dim>(c.j);
  const Block<Dim> k_i = k.asDiagonal() * g.on_i;
  const Block<Dim> k_j = k.asDiagonal() * g.on_j;
  const auto strain_rows = g.on_strain.leftCols(out.boundary.cols());
  add_block(triplets, i, i, Block<Dim>(g.on_i.transpose() * k_i));
  out.border.middleRows<kDofs<Dim>>(i) += k_i.transpose() * strain_rows;
  out.boundary += strain_rows.transpose() * k.asDiagonal() * strain_rows;
  if (c.i == c.j) return;
  add_block(triplets, j, j, Block<Dim>(g.on_j.transpose() * k_j));
  if (i > j)
    add_block(triplets, i, j, Block<Dim>(g.on_i.transpose() * k_j));
  else
    add_block(triplets, j, i, Block<Dim>(g.on_j.transpose() * k_i));
  out.border.middleRows<kDofs<Dim>>(j) += k_j.transpose() * strain_rows;
}

}  // namespace

template <int Dim>
Mat<Dim> unit_strain(int column) {
  Mat<Dim> e = Mat<Dim>::Zero();
  if (column < Dim) {
    e(column, column) = 1.0;
  } else {
    const auto [a, b] = shear_pair<Dim>(column - Dim);
    e(a, b) = e(b, a) = 0.5;
  }
  return e;
}

template <int Dim>
ContactRows<Dim> contact_rows(const NetworkContact<Dim>& c) {
  constexpr int kTurn = kRotations<Dim>;
  ContactRows<Dim> g;
  g.on_i.setZero();
  g.on_j.setZero();
  g.on_strain.setZero();
  for (int a = 0; a < Dim; ++a) {
    // Overlap grows when j approaches i; tangential displacements count along the tangent.
    const Vec<Dim> axis = a == 0 ? Vec<Dim>(-c.frame.col(0)) : Vec<Dim>(c.frame.col(a));
    g.on_i.template block<1, Dim>(a, 0) = -axis.transpose();
    g.on_j.template block<1, Dim>(a, 0) = axis.transpose();
    g.on_i.template block<1, kTurn>(a, Dim) = -moment<double>(c.arm_i, axis).transpose();
    g.on_j.template block<1, kTurn>(a, Dim) = moment<double>(c.arm_j, axis).transpose();
    for (int e = 0; e < kSymmetric<Dim>; ++e) g.on_strain(a, e) = -axis.dot(unit_strain<Dim>(e) * c.branch);
  }
  g.on_i.template bottomRightCorner<kTurn, kTurn>() = -Mat<kTurn>::Identity();
  g.on_j.template bottomRightCorner<kTurn, kTurn>() = Mat<kTurn>::Identity();
  if (c.i == c.j) {
    g.on_i += g.on_j;
    g.on_j.setZero();
  }
  return g;
}

template <int Dim>
Eigen::Matrix<double, kDofs<Dim>, 1> row_stiffness(const NetworkContact<Dim>& c) {
  Eigen::Matrix<double, kDofs<Dim>, 1> k;
  k[0] = c.kn;
  k.template segment<Dim - 1>(1).setConstant(c.kt);
  k.template tail<kRotations<Dim>>().setConstant(c.kr);
  return k;
}

template <int Dim>
Eigen::SparseMatrix<double> rigidity_matrix(const ContactNetwork<Dim>& network, StrainSet strains) {
  const int n_columns = network.n_unknowns() + n_strains<Dim>(strains);
  Triplets triplets;
  int row = 0;
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> g = contact_rows(c);
    for (int a = 0; a < kDofs<Dim>; ++a, ++row) {
      for (int b = 0; b < kDofs<Dim>; ++b) {
        triplets.emplace_back(row, first_unknown<Dim>(c.i) + b, g.on_i(a, b));
        triplets.emplace_back(row, first_unknown<Dim>(c.j) + b, g.on_j(a, b));
      }
      for (int e = 0; e < n_strains<Dim>(strains); ++e)
        triplets.emplace_back(row, network.n_unknowns() + e, g.on_strain(a, e));
    }
  }
  Eigen::SparseMatrix<double> matrix(row, n_columns);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

template <int Dim>
StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>& network, const StiffnessOptions& options) {
  const int n = network.n_unknowns();
  const int n_boundary = n_strains<Dim>(options.strains);
  StiffnessMatrix out;
  out.border = Eigen::MatrixXd::Zero(n, n_boundary);
  out.boundary = Eigen::MatrixXd::Zero(n_boundary, n_boundary);
  Triplets triplets;
  triplets.reserve(network.contacts.size() * kDofs<Dim> * (2 * kDofs<Dim> + 1) * (options.prestress ? 2 : 1));
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> rows = contact_rows(c);
    add_rows<Dim>(c, rows, row_stiffness(c), triplets, out);
    if (options.prestress) add_rows<Dim>(c, translation_rows(rows), row_prestress(c), triplets, out);
  }
  out.grains.resize(n, n);
  out.grains.setFromTriplets(triplets.begin(), triplets.end());
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
  Triplets triplets;
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

#define FLOC_INSTANTIATE(Dim)                                                                     \
  template Mat<Dim> unit_strain<Dim>(int);                                                        \
  template ContactRows<Dim> contact_rows(const NetworkContact<Dim>&);                             \
  template Eigen::Matrix<double, kDofs<Dim>, 1> row_stiffness(const NetworkContact<Dim>&);        \
  template Eigen::SparseMatrix<double> rigidity_matrix(const ContactNetwork<Dim>&, StrainSet);    \
  template StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>&, const StiffnessOptions&); \
  template Eigen::MatrixXd affine_stiffness(const ContactNetwork<Dim>&, StrainSet);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
