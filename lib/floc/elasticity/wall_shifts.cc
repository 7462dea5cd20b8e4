#include "floc/elasticity/wall_shifts.h"

#include <cmath>
#include <limits>

#include "floc/base/dense_solvers.h"

namespace floc {
namespace {

/// A stiffness against a wall shift (common displacement of the two walls of an axis) counts as zero if it is at most
/// this share of the stiffness against strain, because it may be due to rounding. There is no stiffness if the grains
/// between the two walls touch no other boundary and move along with the walls.
constexpr double kFreeShift = 1e-11;

}  // namespace

template <int Dim>
void relax_wall_shifts(const ContactNetwork<Dim>& network, ElasticResponse& out) {
  const auto n = static_cast<Eigen::Index>(network.wall_axes.size());
  const Eigen::Index n_strains = out.relaxed.rows() - n;
  out.wall_shift = Eigen::MatrixXd::Zero(Dim, n_strains);
  if (n == 0) return;
  // The wall shifts (common displacements of the two walls of an axis) are eliminated by a pseudo-inverse. In a shift
  // without stiffness, the grains move along without resistance, and the amplitude has no influence on the forces.
  const SymmetricEigen eigen = symmetric_eigen(out.relaxed.bottomRightCorner(n, n));
  const double least = kFreeShift * out.relaxed.trace();
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    if (std::abs(eigen.values[k]) > least)
      inverse[k] = 1.0 / eigen.values[k];
    else
      ++out.n_free_shifts;
    if (eigen.values[k] < -least) ++out.n_negative_shifts;
  }
  out.n_negative += out.n_negative_shifts;
  Eigen::MatrixXd with_strain = Eigen::MatrixXd::Identity(out.relaxed.rows(), n_strains);
  with_strain.bottomRows(n) = -eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose() *
                              out.relaxed.bottomLeftCorner(n, n_strains);
  for (Eigen::Index k = 0; k < n; ++k)
    out.wall_shift.row(network.wall_axes[static_cast<std::size_t>(k)]) =
        wall_shift_unit(network) * with_strain.row(n_strains + k);
  // The stiffness after relaxation is computed as T^T K T, where the matrix T contains the wall shifts that relax under
  // each strain. The error of this product has the bound |T|^T error |T|; a Schur complement would not give a bound. If
  // an entry of `error` is infinite, this bound would contain NaN; all bounds are then set to infinity.
  const Eigen::MatrixXd magnitude = with_strain.cwiseAbs();
  out.relaxed = (with_strain.transpose() * out.relaxed * with_strain).eval();
  const bool bounded = out.error.allFinite();
  out.error = (magnitude.transpose() * out.error * magnitude).eval();
  if (!bounded) out.error.setConstant(std::numeric_limits<double>::infinity());
  out.fluctuation = (out.fluctuation * with_strain).eval();
}

template void relax_wall_shifts(const ContactNetwork<2>&, ElasticResponse&);
template void relax_wall_shifts(const ContactNetwork<3>&, ElasticResponse&);

}  // namespace floc
