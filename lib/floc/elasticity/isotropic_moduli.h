#pragma once

#include <Eigen/Core>

namespace floc {

/// Returns the shear modulus (C11 + C22 - 2 C12)/4 of an isotropic material; in 3D its mean over the three pairs of
/// axes.
/// @param diagonal_block  C: the Dim x Dim block of the matrix of moduli that belongs to the diagonal strains
double pure_shear_modulus(const Eigen::MatrixXd& diagonal_block);

/// Returns the bulk modulus, which is the mean of the entries of C: the increase of pressure divided by the relative
/// decrease of volume, if all diagonal strains are equal.
/// @param diagonal_block  C: the Dim x Dim block of the matrix of moduli that belongs to the diagonal strains
double bulk_modulus(const Eigen::MatrixXd& diagonal_block);

/// Returns a bound on the error of the result of pure_shear_modulus().
/// @param diagonal_block_error  bounds on the errors of the entries C11, C12, ... of the argument of
/// pure_shear_modulus()
double pure_shear_modulus_error(const Eigen::MatrixXd& diagonal_block_error);
/// Returns a bound on the error of the result of bulk_modulus().
/// @param diagonal_block_error  bounds on the errors of the entries C11, C12, ... of the argument of bulk_modulus()
double bulk_modulus_error(const Eigen::MatrixXd& diagonal_block_error);

}  // namespace floc
