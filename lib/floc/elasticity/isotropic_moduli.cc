#include "floc/elasticity/isotropic_moduli.h"

namespace floc {

double pure_shear_modulus(const Eigen::MatrixXd& c) {
  const auto dim = static_cast<double>(c.rows());
  const double n_pairs = 0.5 * dim * (dim - 1.0);
  const double off_diagonal = c.sum() - c.trace();
  return ((dim - 1.0) * c.trace() - off_diagonal) / (4.0 * n_pairs);
}

double bulk_modulus(const Eigen::MatrixXd& c) {
  return c.mean();
}

double pure_shear_modulus_error(const Eigen::MatrixXd& error) {
  // pure_shear_modulus() multiplies the off-diagonal entries by a negative number. The errors of these entries are
  // therefore negated, so that all errors add up.
  Eigen::MatrixXd worst = -error;
  worst.diagonal() = error.diagonal();
  return pure_shear_modulus(worst);
}

double bulk_modulus_error(const Eigen::MatrixXd& error) {
  return error.mean();
}

}  // namespace floc
