#pragma once

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Number of independent sets of contact forces in balance without load (docs/physics.md, "Stability and
/// mechanisms").
struct Indeterminacy {
  /// h = components - unknowns + null modes: the dimension of the null space of the equilibrium matrix.
  int degree = 0;
  int n_components = 0;  ///< force and moment components of contacts that have a stiffness
  int n_unknowns = 0;    ///< kDofs per grain with contacts, and the strains of the cell
  int n_null_modes = 0;  ///< k: motions free by structure, mechanisms, strains that cost nothing
};

/// Computes the indeterminacy of a network with its diagonal strains (3 N_b + 2 unknowns in 2D, 6 N_b + 3 in
/// 3D) or all symmetric ones.
/// @param response  response of the same network, over these strains at least, without prestress
template <int Dim>
Indeterminacy force_indeterminacy(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                  StrainSet strains = StrainSet::diagonal);

}  // namespace floc
