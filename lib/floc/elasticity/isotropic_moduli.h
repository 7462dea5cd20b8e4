#pragma once

#include <Eigen/Core>

namespace floc {

/// Returns (C11 + C22 - 2 C12)/4 of a matrix of moduli over the diagonal strains, in 3D the mean over the pairs
/// of axes: the shear modulus, if the material is isotropic.
double pure_shear_modulus(const Eigen::MatrixXd& diagonal_block);

/// Returns the mean of the entries of a matrix of moduli over the diagonal strains: the pressure per relative
/// decrease of volume, with all strains equal.
double bulk_modulus(const Eigen::MatrixXd& diagonal_block);

/// Return bounds on the errors of these moduli. @param diagonal_block_error  bound on the error of each entry
double pure_shear_modulus_error(const Eigen::MatrixXd& diagonal_block_error);
double bulk_modulus_error(const Eigen::MatrixXd& diagonal_block_error);

}  // namespace floc
