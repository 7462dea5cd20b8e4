#pragma once

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Degree of static indeterminacy of a contact network: number of independent sets of contact forces that balance
/// without load (docs/physics.md, "Stability and mechanisms").
struct Indeterminacy {
  /// Degree of indeterminacy h = components - unknowns + null modes: the dimension of the null space of the equilibrium
  /// matrix.
  int degree = 0;
  int n_components = 0;  ///< number of force and moment components of contacts that have a stiffness
  int n_unknowns = 0;    ///< number of unknowns: kDofs per grain with contacts, and the strains of the cell
  int n_null_modes = 0;  ///< number of motions without stiffness: free motions, mechanisms, strains
};

/// Computes the indeterminacy of a network, either with the diagonal strains as unknowns (3 N_b + 2 unknowns in 2D, 6
/// N_b + 3 in 3D, for N_b grains with contacts) or with all strains.
/// @param response  response of the same network without prestress; its strains must include `strains`
template <int Dim>
Indeterminacy force_indeterminacy(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                  StrainSet strains = StrainSet::diagonal);

}  // namespace floc
