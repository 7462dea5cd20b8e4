#include "floc/network/stiffness_matrix.h"

#include <algorithm>
#include <vector>

#include "floc/network/geometric_springs.h"
#include "floc/network/geometric_stiffness.h"
#include "floc/network/symmetric_sum.h"

namespace floc {
namespace {

/// Adds the symmetric part of the geometric stiffness that follows from the tangential force and the moments of a
/// contact. This part is zero for a contact with a wall, because a wall does not rotate, and for an attraction across a
/// gap, because such an attraction has no tangential force and no moment.
template <int Dim>
void add_shear_prestress(const NetworkContact<Dim>& c, StrainSet strains, SymmetricSum<kDofs<Dim>>& sum) {
  if (c.on_wall() || c.distant) return;
  NetworkContact<Dim> without_normal_force = c;
  without_normal_force.normal_force = 0.0;
  const MotionMatrix<Dim> k = geometric_stiffness(without_normal_force);
  const GrainMotions<Dim> of_grains = grain_motions(c, 1.0, 1.0);
  // A strain or a displacement of walls displaces the two grains of the contact relative to each other, but does not
  // rotate the grains.
  Eigen::Matrix<double, kMotionRows<Dim>, Eigen::Dynamic> of_boundary =
      Eigen::Matrix<double, kMotionRows<Dim>, Eigen::Dynamic>::Zero(kMotionRows<Dim>, sum.boundary().cols());
  for (int e = 0; e < n_strains<Dim>(strains); ++e)
    of_boundary.col(e).template head<Dim>() = -unit_strain<Dim>(e) * c.branch;
  add_contact(c.i, c.j, of_grains.on_i, of_grains.on_j, of_boundary,
              MotionMatrix<Dim>(0.5 * (k + k.transpose())), sum);
}

}  // namespace

template <int Dim>
StiffnessMatrix stiffness_matrix(const ContactNetwork<Dim>& network, const StiffnessOptions& options) {
  const bool shifts = options.wall_shifts && !network.wall_axes.empty();
  const int n_boundary =
      shifts ? n_boundary_unknowns(network, options.strains) : n_strains<Dim>(options.strains);
  SymmetricSum<kDofs<Dim>> sum(network.n_grains, network.contacts, n_boundary);
  const auto add = [&](const NetworkContact<Dim>& c, const ContactRows<Dim>& rows, const RowStiffness<Dim>& k) {
    const auto add_with = [&](const auto& boundary) {
      add_contact(c.i, c.j, rows.on_i, rows.on_j, boundary, k.asDiagonal(), sum);
    };
    if (shifts)
      add_with(boundary_rows(network, rows, options.strains));
    else
      add_with(rows.on_strain.leftCols(n_boundary));
  };
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> rows = contact_rows(c);
    add(c, rows, row_stiffness(c));
    if (options.prestress)
      for_each_geometric_term(network, c, rows, [&](const auto& moved, const auto& k) { add(c, moved, k); });
    if (options.shear_prestress && network.geometric.empty()) add_shear_prestress(c, options.strains, sum);
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
