#pragma once

#include <Eigen/Core>

namespace floc {

/// (C11 + C22 - 2 C12)/4 of a matrix of moduli over the diagonal strains, in 3D the mean over the pairs of
/// axes: what an isotropic material would have as shear modulus.
double pure_shear_modulus(const Eigen::MatrixXd& diagonal_block);

/// Mean of the entries of such a matrix: pressure over decrease of volume, all strains equal.
double bulk_modulus(const Eigen::MatrixXd& diagonal_block);

/// Bounds of the errors of the two above for a bound of each entry.
double pure_shear_modulus_error(const Eigen::MatrixXd& diagonal_block_error);
double bulk_modulus_error(const Eigen::MatrixXd& diagonal_block_error);

}  // namespace floc
