#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Strains of the cell that no stiffness resists when the grains relax.
struct StrainMechanisms {
  /// strains that no stiffness resists, one per column, orthonormal; rows in the order of StrainSet
  Eigen::MatrixXd strains;
  /// fluctuation of the grains under each strain in `strains`; one row per unknown of the stiffness matrix
  Eigen::MatrixXd motions;
  /// Names of the moduli that are zero because of these strains: "C11" etc. for diagonal entries of the moduli C; "B"
  /// or "G" if the strain that defines the modulus is in the span of these strains; "B_S" if an isotropic stress does
  /// work on one of these strains.
  std::vector<std::string> vanishing;
};

/// Returns the strains of the cell that no stiffness resists, as orthonormal columns: the eigenvectors of `relaxed`
/// whose absolute eigenvalue is at most 1e-11 of the trace of `affine`.
/// @param relaxed  volume times stress per unit strain after relaxation of the grains, see ElasticResponse
/// @param affine   volume times stress per unit strain without relaxation of the grains, see affine_stiffness()
Eigen::MatrixXd vanishing_strains(const Eigen::MatrixXd& relaxed, const Eigen::MatrixXd& affine);

/// Finds the strains of the cell that no stiffness resists, and the moduli that are zero because of them.
/// @param affine  volume times stress per unit strain without relaxation of the grains, see affine_stiffness(); for
///                the same network and the same strains as `response`
template <int Dim>
StrainMechanisms strain_mechanisms(const ElasticResponse& response, const Eigen::MatrixXd& affine);

/// Numbers of mechanisms that follow from the list of touching grains alone. They do not depend on the positions of the
/// grains.
struct StructuralMechanisms {
  int n_mechanisms = 0;  ///< number of mechanisms of the grains at zero strain; free motions do not count
  int n_coupled = 0;     ///< number of strains of the cell that no stiffness resists
};

/// Counts the mechanisms that a network has after its grains have been moved to random (general) positions. At such
/// positions, no near-mechanism disturbs the count. Additional mechanisms of the original network result from its
/// special geometry. At the random positions, lever arms are still parallel to the normals, and all stiffnesses that
/// are not zero are of order one.
template <int Dim>
StructuralMechanisms structural_mechanisms(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
