#pragma once

#include "floc/network/geometric_stiffness.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {

/// Returns the part of the stiffness of a contact of grains with corners that the stiffnesses K_N and K_T of its contact
/// point (contact_rows()) do not give: the change of its forces and moments due to the changes of its gap, normal and
/// arms, in the form of geometric_stiffness() for round grains. The matrix is not symmetric.
/// @param contact  contact of contact_network(packing), with the forces of the contact law
/// @pre the grains have corners
template <int Dim>
MotionMatrix<Dim> geometric_stiffness(const Packing<Dim>& packing, const NetworkContact<Dim>& contact);

/// Returns the geometric springs of all contacts of a packing of grains with corners. If the grains of a contact move,
/// its forces and moments change. The stiffnesses K_N and K_T of the contact point (contact_rows()) give one part of
/// this change. The geometric springs give the symmetric part of the rest, for all forces of the contact.
///
/// The changes of the gap, the normal and the contact point are central differences of contact_manifold() or, at walls, of
/// plane_manifold(), because they depend on the features (vertices, edges or faces) that meet: a vertex on a face moves
/// with one of the grains, the corner at which an edge leaves a face moves with both, and the normal of two crossed edges
/// rotates with both. The tangential force rotates with the mean rotation of the two grains and stays in the tangential
/// plane, as in contact dynamics.
/// @pre the grains have corners
template <int Dim>
std::vector<GeometricSprings<Dim>> geometric_springs(const Packing<Dim>& packing);

/// Let B be the matrix whose product with the unknowns is the elongations of the geometric springs of a contact.
/// Returns the rows `first` to `first + kDofs - 1` of B. Rows beyond the last spring are zero.
template <int Dim>
ContactRows<Dim> geometric_rows(const NetworkContact<Dim>& contact, const GeometricSprings<Dim>& springs,
                                int first);

/// Returns the stiffnesses of the springs of geometric_rows().
template <int Dim>
RowStiffness<Dim> geometric_row_stiffness(const GeometricSprings<Dim>& springs, int first);

/// Calls visit(rows, stiffness) for the geometric terms of the normal force of a contact of round grains, or for the
/// geometric springs of a contact of grains with corners. The arguments are ContactRows and RowStiffness.
/// @param rows  contact_rows() of the contact
/// @pre if the grains have corners, network.geometric contains their springs
template <int Dim, class Visit>
void for_each_geometric_term(const ContactNetwork<Dim>& network, const NetworkContact<Dim>& contact,
                             const ContactRows<Dim>& rows, const Visit& visit) {
  if (network.geometric.empty()) {
    visit(translation_rows(rows), row_prestress(contact));
    return;
  }
  const GeometricSprings<Dim>& springs = network.geometric[static_cast<std::size_t>(contact.source)];
  for (int first = 0; first < kMotionRows<Dim>; first += kDofs<Dim>)
    visit(geometric_rows(contact, springs, first), geometric_row_stiffness(springs, first));
}

/// Returns how many geometric terms of a contact have a stiffness that is not zero.
/// @pre as for for_each_geometric_term()
template <int Dim>
int n_geometric_terms(const ContactNetwork<Dim>& network, const NetworkContact<Dim>& contact) {
  if (network.geometric.empty()) return static_cast<int>((row_prestress(contact).array() != 0.0).count());
  const GeometricSprings<Dim>& springs = network.geometric[static_cast<std::size_t>(contact.source)];
  return static_cast<int>((springs.stiffness.array() != 0.0).count());
}

}  // namespace floc
