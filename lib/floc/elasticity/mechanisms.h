#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Strains of the cell that cost nothing when the grains follow: mechanisms that couple to strain.
struct StrainMechanisms {
  Eigen::MatrixXd strains;  ///< orthonormal columns, rows in the order of StrainSet
  Eigen::MatrixXd motions;  ///< fluctuation of the grains that goes with each: rows the unknowns of K
  /// Moduli that vanish with them: entries of the diagonal of C by name ("C11"), "B" and "G" where the strain
  /// that they measure is one of these, "B_S" where an isotropic stress would do work on one.
  std::vector<std::string> vanishing;
};

/// Strains that a relaxed stiffness (volume times stress per strain) does not resist: orthonormal columns.
/// @param affine  affine_stiffness() over the same strains; an eigenvalue below 1e-11 of its trace is zero to
///                within rounding
Eigen::MatrixXd vanishing_strains(const Eigen::MatrixXd& relaxed, const Eigen::MatrixXd& affine);

/// @param affine  affine_stiffness() of the same network and strains
template <int Dim>
StrainMechanisms strain_mechanisms(const ElasticResponse& response, const Eigen::MatrixXd& affine);

/// How many mechanisms of a network follow from the way its contacts are connected, and how many of these
/// couple to strain.
struct StructuralMechanisms {
  int n_mechanisms = 0;  ///< of the grains beyond free motions, strains clamped
  int n_coupled = 0;     ///< strains of the cell that cost nothing
};

/// Mechanisms of the same contacts between grains moved to general positions, so that no near-mechanism blurs
/// the count; what the network has beyond it is a coincidence of its geometry, exact or not. Lever arms stay
/// along the normals, and every stiffness that does not vanish is of order one.
template <int Dim>
StructuralMechanisms structural_mechanisms(const ContactNetwork<Dim>& network, StrainSet strains);

}  // namespace floc
