#pragma once

#include <Eigen/Core>

namespace floc {

/// Returns (C11 + C22 - 2 C12)/4 for the moduli C of the diagonal strains, in 3D the mean over the pairs of axes. This
/// is the shear modulus if the material is isotropic.
double pure_shear_modulus(const Eigen::MatrixXd& diagonal_block);

/// Returns the mean of the entries of the moduli C of the diagonal strains: the pressure per relative decrease of
/// volume if all diagonal strains are equal.
double bulk_modulus(const Eigen::MatrixXd& diagonal_block);

/// Returns a bound on the error of pure_shear_modulus(). @param diagonal_block_error  bound on the error of each entry
double pure_shear_modulus_error(const Eigen::MatrixXd& diagonal_block_error);
/// Returns a bound on the error of bulk_modulus(). @param diagonal_block_error  bound on the error of each entry
double bulk_modulus_error(const Eigen::MatrixXd& diagonal_block_error);

}  // namespace floc
