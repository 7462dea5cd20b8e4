#pragma once

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Degree of static indeterminacy of a contact network: number of linearly independent sets of contact forces that
/// balance without any load (docs/physics.md, "Stability and mechanisms").
struct Indeterminacy {
  /// Degree of indeterminacy h = n_components - n_unknowns + n_null_modes: the dimension of the null space of the
  /// equilibrium matrix.
  int degree = 0;
  int n_components = 0;  ///< number of components of contact forces and moments whose stiffness is not zero
  int n_unknowns = 0;    ///< number of unknowns: kDofs per grain with contacts, plus the strains of the cell
  int n_null_modes = 0;  ///< number of motions that no stiffness resists: free motions, mechanisms, strains
};

/// Computes the indeterminacy of a network. The unknowns are the motions of the grains and either the diagonal strains
/// or all strains of the cell. With diagonal strains and N_b grains with contacts, there are 3 N_b + 2 unknowns in 2D
/// and 6 N_b + 3 in 3D.
/// @param response  response of the same network without prestress; its strains must include `strains`
/// @param strains   strains that count as unknowns
template <int Dim>
Indeterminacy force_indeterminacy(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                  StrainSet strains = StrainSet::diagonal);

/// Computes the indeterminacy of the forces of those rigid contacts whose elastic force is above `smallest_force`. The
/// force of a contact that sticks by friction has one component for each direction of space. The force of a contact
/// that slides or has no friction has one component, because the normal force determines the whole force. The forces
/// balance on every grain and give the normal stress on each axis of the cell. Indeterminacy::degree is therefore the
/// number of force components minus the number of independent equations of balance. This degree is the dimension of the
/// set of forces that balance, as long as no further force reaches its limit.
/// @param smallest_force  a contact does not count if its elastic force (the normal force without the adhesion) is at
/// most this value (force), >= 0
/// @pre the packing has no walls
template <int Dim>
Indeterminacy rigid_indeterminacy(const Packing<Dim>& packing, double smallest_force);

}  // namespace floc
