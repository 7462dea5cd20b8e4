#pragma once

#include <Eigen/Core>
#include <vector>

#include "floc/network/tangent_matrix.h"
#include "floc/packing/law/contact_response.h"

namespace floc::test {

/// Returns the packing with the contact forces that its positions and histories give while no grain moves.
template <int Dim>
Packing<Dim> at_rest(const Packing<Dim>& packing) {
  Packing<Dim> at = packing;
  const std::vector<SurfaceMotion<Dim>> still(packing.contacts.size());
  respond<Dim>(at, still, at.contacts);
  return at;
}

/// Returns the columns of a contact that belong to the first n strains.
template <int Dim>
BoundaryColumns<Dim> strain_columns(const NetworkContact<Dim>& c, int n) {
  const Vec<Dim> on_i = c.shear_force - c.normal_force * c.normal();
  BoundaryColumns<Dim> columns;
  columns.displacement.resize(Dim, n);
  columns.follow.resize(n, Dim);
  for (int e = 0; e < n; ++e) {
    columns.displacement.col(e) = -unit_strain<Dim>(e) * c.branch;
    columns.follow.row(e) = -(unit_strain<Dim>(e) * on_i).transpose();
  }
  return columns;
}

/// Returns minus the derivative of the generalised forces with respect to the generalised displacements, with all
/// geometric terms. The displacements are the translations of the grains, the rotations of the grains times their
/// radii, and the first n_strains strains. The generalised forces are conjugate to these displacements. The matrix is
/// not symmetric.
template <int Dim>
Eigen::MatrixXd consistent_tangent(const Packing<Dim>& packing, int n_strains) {
  std::vector<Mat<Dim>> frames;
  for (const Contact<Dim>& c : packing.contacts) frames.push_back(contact_frame(c.normal));
  std::vector<ContactTangent<Dim>> tangents(packing.contacts.size());
  const std::vector<SurfaceMotion<Dim>> still(packing.contacts.size());
  contact_tangents<Dim>(packing, packing.contacts, still, frames, tangents);
  const ContactNetwork<Dim> network = contact_network(at_rest(packing));
  TangentMatrix<Dim> matrix(packing.grains.radius, contact_graph(network.n_grains, network.contacts),
                            n_strains);
  matrix.reset(0.0);
  for (std::size_t k = 0; k < frames.size(); ++k)
    matrix.add(network.contacts[k], tangents[k], strain_columns(network.contacts[k], n_strains));
  return matrix.matrix();
}

}  // namespace floc::test
