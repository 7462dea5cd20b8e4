#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Strains of the cell that cost nothing when the grains follow: mechanisms that couple to strain.
struct StrainMechanisms {
  Eigen::MatrixXd strains;  ///< orthonormal columns, rows in the order of StrainSet
  Eigen::MatrixXd motions;  ///< fluctuation of the grains under each strain: rows are the unknowns of K
  /// Moduli that vanish with them: entries of the diagonal of C by name ("C11"), "B" and "G" where the strain
  /// that defines them is one of these, "B_S" where an isotropic stress would do work on one.
  std::vector<std::string> vanishing;
};

/// Returns the strains that a relaxed stiffness (volume times stress per strain) does not resist, as
/// orthonormal columns.
/// @param affine  affine_stiffness() over the same strains; an eigenvalue below 1e-11 of its trace is zero to
///                within rounding
Eigen::MatrixXd vanishing_strains(const Eigen::MatrixXd& relaxed, const Eigen::MatrixXd& affine);

/// Finds the strains that cost nothing, and the moduli that vanish with them.
/// @param affine  affine_stiffness() of the same network and strains
template <int Dim>
StrainMechanisms strain_mechanisms(const ElasticResponse& response, const Eigen::MatrixXd& affine);

/// Numbers of the mechanisms of a network that follow from the connections of its contacts, and of those among
/// them that couple to strain.
struct StructuralMechanisms {
  int n_mechanisms = 0;  ///< mechanisms of the grains beyond free motions, strains clamped
  int n_coupled = 0;     ///< strains of the cell that cost nothing
};

/// Counts the mechanisms of the contacts of a network between grains moved to general positions, where no
/// near-mechanism disturbs the count. Mechanisms that the network has beyond these are due to its special
/// geometry. Lever arms stay along the normals, and every stiffness that does not vanish is of order one.
template <int Dim>
StructuralMechanisms structural_mechanisms(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
