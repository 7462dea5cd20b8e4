#include "floc/network/rigidity_matrix.h"

#include <array>
#include <cassert>
#include <cmath>

namespace floc {
namespace {

/// Returns the two axes of a shear strain. Shear strains are numbered in Voigt's order: 23, 13, 12 in 3D; 12 in 2D.
template <int Dim>
constexpr std::array<int, 2> shear_pair(int shear) {
  if constexpr (Dim == 2) return {0, 1};
  constexpr std::array<std::array<int, 2>, 3> kPairs{{{1, 2}, {0, 2}, {0, 1}}};
  return kPairs[shear];
}

using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Appends the nonzero entries of one row of a block to a row of the matrix. Columns must be appended in ascending
/// order.
void append(RowMajorMatrix& matrix, int row, int first_column, const auto& values) {
  for (int b = 0; b < values.size(); ++b)
    if (values[b] != 0.0) matrix.insertBack(row, first_column + b) = values[b];
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
  constexpr int kRotationDofs = kRotations<Dim>;
  ContactRows<Dim> g;
  g.on_i.setZero();
  g.on_j.setZero();
  g.on_strain.setZero();
  for (int a = 0; a < Dim; ++a) {
    // The overlap increases if j moves towards i; a tangential displacement is positive if j moves along the tangent
    // relative to i.
    const Vec<Dim> axis = a == 0 ? Vec<Dim>(-c.frame.col(0)) : Vec<Dim>(c.frame.col(a));
    g.on_i.template block<1, Dim>(a, 0) = -axis.transpose();
    g.on_j.template block<1, Dim>(a, 0) = axis.transpose();
    g.on_i.template block<1, kRotationDofs>(a, Dim) = -moment<double>(c.arm_i, axis).transpose();
    g.on_j.template block<1, kRotationDofs>(a, Dim) = moment<double>(c.arm_j, axis).transpose();
    // A strain E displaces j relative to i by -E branch.
    for (int e = 0; e < Dim; ++e) g.on_strain(a, e) = -axis[e] * c.branch[e];
    for (int e = Dim; e < kSymmetric<Dim>; ++e) {
      const auto [p, q] = shear_pair<Dim>(e - Dim);
      g.on_strain(a, e) = -0.5 * (axis[p] * c.branch[q] + axis[q] * c.branch[p]);
    }
  }
  const Mat<kRotationDofs> axes = rotation_axes(c.frame);
  g.on_i.template bottomRightCorner<kRotationDofs, kRotationDofs>() = -axes.transpose();
  g.on_j.template bottomRightCorner<kRotationDofs, kRotationDofs>() = axes.transpose();
  g.on_wall.setZero();
  if (c.on_wall()) g.on_wall.row(0) = -c.frame.col(0).transpose();
  if (c.i == c.j) {
    if (!c.on_wall()) g.on_i += g.on_j;
    g.on_j.setZero();
  }
  return g;
}

template <int Dim>
RotationVector<Dim> normal_moment(const NetworkContact<Dim>& c, int grain) {
  RotationVector<Dim> out = RotationVector<Dim>::Zero();
  if (grain == c.i) out += moment<double>(c.arm_i, c.normal());
  if (grain == c.j && !c.on_wall()) out -= moment<double>(c.arm_j, c.normal());
  return out;
}

template <int Dim>
int n_boundary_unknowns(const ContactNetwork<Dim>& network, StrainSet strains) {
  return n_strains<Dim>(strains) + static_cast<int>(network.wall_axes.size());
}

template <int Dim>
double wall_shift_unit(const ContactNetwork<Dim>& network) {
  return std::pow(network.volume, 1.0 / Dim);
}

template <int Dim>
BoundaryRows<Dim> boundary_rows(const ContactNetwork<Dim>& network, const ContactRows<Dim>& rows,
                                StrainSet strains) {
  const int n = n_strains<Dim>(strains);
  BoundaryRows<Dim> out(kDofs<Dim>, n_boundary_unknowns(network, strains));
  out.leftCols(n) = rows.on_strain.leftCols(n);
  if (network.wall_axes.empty()) return out;
  const double unit = wall_shift_unit(network);
  // The unknown of an axis is a displacement divided by `unit`. Therefore the motion per unknown is the motion per
  // displacement, multiplied by `unit`.
  for (int k = 0; k < static_cast<int>(network.wall_axes.size()); ++k)
    out.col(n + k) = unit * rows.on_wall.col(network.wall_axes[k]);
  return out;
}

template <int Dim>
RowStiffness<Dim> row_stiffness(const NetworkContact<Dim>& c) {
  RowStiffness<Dim> k;
  k[0] = c.kn;
  k.template segment<Dim - 1>(1).setConstant(c.kt);
  k.template tail<kRotations<Dim>>().setConstant(c.kr);
  if constexpr (Dim == 3) k[Dim] = c.ktw;
  return k;
}

template <int Dim>
ContactRows<Dim> translation_rows(ContactRows<Dim> rows) {
  rows.on_i.template rightCols<kRotations<Dim>>().setZero();
  rows.on_j.template rightCols<kRotations<Dim>>().setZero();
  rows.on_i.template bottomRows<kRotations<Dim>>().setZero();
  rows.on_j.template bottomRows<kRotations<Dim>>().setZero();
  return rows;
}

template <int Dim>
RowStiffness<Dim> row_prestress(const NetworkContact<Dim>& c) {
  RowStiffness<Dim> k = RowStiffness<Dim>::Zero();
  if (!c.on_wall()) k.template segment<Dim - 1>(1).setConstant(-c.normal_force / c.branch.norm());
  return k;
}

template <int Dim>
Eigen::SparseMatrix<double> rigidity_matrix(const ContactNetwork<Dim>& network, StrainSet strains) {
  const int n_boundary = n_strains<Dim>(strains);
  RowMajorMatrix matrix(kDofs<Dim> * static_cast<int>(network.contacts.size()),
                        network.n_unknowns() + n_boundary);
  matrix.reserve(matrix.rows() * (2 * kDofs<Dim> + n_boundary));
  int row = 0;
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> g = contact_rows(c);
    for (int a = 0; a < kDofs<Dim>; ++a, ++row) {
      matrix.startVec(row);
      // The entries of a row must be appended in ascending order of their columns, so the grain with the smaller number
      // comes first. If i = j, `on_j` is zero and adds no entries to the same columns.
      const bool i_first = c.i <= c.j;
      append(matrix, row, first_unknown<Dim>(i_first ? c.i : c.j), (i_first ? g.on_i : g.on_j).row(a));
      append(matrix, row, first_unknown<Dim>(i_first ? c.j : c.i), (i_first ? g.on_j : g.on_i).row(a));
      append(matrix, row, network.n_unknowns(), g.on_strain.row(a).head(n_boundary));
    }
  }
  matrix.finalize();
  return matrix;
}

template <int Dim>
Eigen::SparseMatrix<double> scaled_rigidity_matrix(const ContactNetwork<Dim>& network, StrainSet strains) {
  Eigen::VectorXd root(kDofs<Dim> * network.contacts.size());
  for (int c = 0; c < static_cast<int>(network.contacts.size()); ++c)
    root.segment<kDofs<Dim>>(kDofs<Dim> * c) = row_stiffness(network.contacts[c]).cwiseSqrt();
  assert(!root.hasNaN());
  return root.asDiagonal() * rigidity_matrix(network, strains);
}

#define FLOC_INSTANTIATE(Dim)                                                                               \
  template Mat<Dim> unit_strain<Dim>(int);                                                                  \
  template ContactRows<Dim> contact_rows(const NetworkContact<Dim>&);                                       \
  template RotationVector<Dim> normal_moment(const NetworkContact<Dim>&, int);                              \
  template int n_boundary_unknowns(const ContactNetwork<Dim>&, StrainSet);                                  \
  template double wall_shift_unit(const ContactNetwork<Dim>&);                                              \
  template BoundaryRows<Dim> boundary_rows(const ContactNetwork<Dim>&, const ContactRows<Dim>&, StrainSet); \
  template RowStiffness<Dim> row_stiffness(const NetworkContact<Dim>&);                                     \
  template ContactRows<Dim> translation_rows(ContactRows<Dim>);                                             \
  template RowStiffness<Dim> row_prestress(const NetworkContact<Dim>&);                                     \
  template Eigen::SparseMatrix<double> rigidity_matrix(const ContactNetwork<Dim>&, StrainSet);              \
  template Eigen::SparseMatrix<double> scaled_rigidity_matrix(const ContactNetwork<Dim>&, StrainSet);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
