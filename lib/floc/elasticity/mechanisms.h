#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Strains of the cell that no stiffness resists when the grains relax: mechanisms that couple to strain.
struct StrainMechanisms {
  Eigen::MatrixXd strains;  ///< one strain per column, orthonormal; rows in the order of StrainSet
  /// fluctuation of the grains under each strain; rows are the unknowns of the stiffness matrix
  Eigen::MatrixXd motions;
  /// Names of the moduli that are zero because of these strains: "C11" etc. for diagonal entries of C; "B" and "G" if
  /// the strain that defines the modulus is one of these; "B_S" if an isotropic stress does work on one of them.
  std::vector<std::string> vanishing;
};

/// Returns the strains without stiffness as orthonormal columns.
/// @param relaxed  volume times stress per strain, with the grains relaxed, see ElasticResponse
/// @param affine   affine_stiffness() for the same strains; an eigenvalue of `relaxed` below 1e-11 of its trace counts
///                 as zero
Eigen::MatrixXd vanishing_strains(const Eigen::MatrixXd& relaxed, const Eigen::MatrixXd& affine);

/// Finds the strains that no stiffness resists, and the moduli that are zero because of them.
/// @param affine  affine_stiffness() of the same network and strains
template <int Dim>
StrainMechanisms strain_mechanisms(const ElasticResponse& response, const Eigen::MatrixXd& affine);

/// Numbers of mechanisms of a network that follow from the connections of its contacts alone: mechanisms of the grains,
/// and strains of the cell.
struct StructuralMechanisms {
  int n_mechanisms = 0;  ///< number of mechanisms of the grains at fixed strains, without free motions
  int n_coupled = 0;     ///< number of strains of the cell that no stiffness resists
};

/// Counts the mechanisms of a network after its grains have been moved to general positions, where no near-mechanism
/// disturbs the count. If the original network has more mechanisms, they are due to its special geometry. Lever arms
/// stay along the normals, and every stiffness that is not zero is set to order one.
template <int Dim>
StructuralMechanisms structural_mechanisms(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
