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

}  // namespace floc
