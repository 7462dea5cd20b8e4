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

/// Computes the indeterminacy of a network. The unknowns of the cell are either its diagonal strains (3 N_b + 2
/// unknowns in 2D, 6 N_b + 3 in 3D, for N_b grains with contacts) or all its strains.
/// @param response  response of the same network without prestress; its strains must include `strains`
/// @param strains   strains that count as unknowns
template <int Dim>
Indeterminacy force_indeterminacy(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                  StrainSet strains = StrainSet::diagonal);

}  // namespace floc
