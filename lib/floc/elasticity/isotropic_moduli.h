#pragma once

#include <Eigen/Core>

namespace floc {

/// (C11 + C22 - 2 C12)/4 of a matrix of moduli over the diagonal strains, in 3D the mean over the pairs of
/// axes: the shear modulus, if the material is isotropic.
double pure_shear_modulus(const Eigen::MatrixXd& diagonal_block);

/// Mean of the entries of such a matrix: pressure over decrease of volume, all strains equal.
double bulk_modulus(const Eigen::MatrixXd& diagonal_block);

/// Bounds on the errors of the two above, for a bound on each entry.
double pure_shear_modulus_error(const Eigen::MatrixXd& diagonal_block_error);
double bulk_modulus_error(const Eigen::MatrixXd& diagonal_block_error);

}  // namespace floc
