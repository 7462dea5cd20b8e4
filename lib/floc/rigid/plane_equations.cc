#include "floc/rigid/plane_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// Smallest shift of the diagonal of the scaled matrix, whose diagonal elements are 1.
constexpr double kLeastShift = 1e-14;
constexpr int kMostShifts = 40;
/// If a shift is too small, the next shift is larger by the factor kNextShift. The first shift after the smallest shift
/// is kFirstShift times the shift that the last matrix needed.
constexpr double kNextShift = 6.0, kFirstShift = 1.0 / 8.0;
/// If the scaled equations of a plane are not positive definite, the absolute values of their eigenvalues are increased
/// to at least this value.
constexpr double kLeastStiffness = 1e-12;

}  // namespace

void PlaneEquations::set_pattern(const std::vector<SeparatingPlane>& planes) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const SeparatingPlane& p : planes)
    for (const int a : p.unknown)
      for (const int b : p.unknown)
        if (a >= b && b >= 0) entries.emplace_back(a, b, 0.0);
  // The objective couples the unknowns of each grain to each other, and the unknowns of the walls and of the cell to
  // each other.
  group_.clear();
  for (int row = 0; row < n_; ++row) {
    const int grain = std::min(row / 6, n_grains_);
    group_.push_back(grain < n_grains_ ? grain : grain + row - 6 * n_grains_);
    for (int column = 6 * grain; column <= row; ++column) entries.emplace_back(row, column, 0.0);
  }
  matrix_.resize(n_, n_);
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

void PlaneEquations::reset() {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  load_.setZero(n_);
}

void PlaneEquations::add(const std::vector<SeparatingPlane>& planes, const GrainVertices& vertices,
                         const GapTerms& terms) {
  eliminated_.resize(planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k) {
    PlaneMatrix full = PlaneMatrix::Zero();
    PlaneVector load = PlaneVector::Zero();
    add_gaps(vertices, planes[k], terms, full, load);
    Eigen::Matrix<double, kPairUnknowns, kPairUnknowns> block =
        full.topLeftCorner<kPairUnknowns, kPairUnknowns>();
    Eigen::Matrix<double, kPairUnknowns, 1> of_pair = load.head<kPairUnknowns>();
    if (!planes[k].is_wall) {
      Eliminated& e = eliminated_[k];
      e.inverse = positive_inverse(full.bottomRightCorner<kPlaneUnknowns, kPlaneUnknowns>());
      e.coupling = full.topRightCorner<kPairUnknowns, kPlaneUnknowns>();
      e.load = load.tail<kPlaneUnknowns>();
      block -= e.coupling * e.inverse * e.coupling.transpose();
      of_pair -= e.coupling * e.inverse * e.load;
    }
    for (int a = 0; a < kPairUnknowns; ++a) {
      const int row = planes[k].unknown[a];
      if (row < 0) continue;
      load_[row] += of_pair[a];
      for (int b = 0; b < kPairUnknowns; ++b)
        if (const int column = planes[k].unknown[b]; column >= 0 && row >= column)
          add(row, column, block(a, b));
    }
  }
}

/// Returns the inverse of the equations of a plane, in which turns and displacements are scaled to be comparable. If the
/// equations are not positive definite, their eigenvalues are replaced by their absolute values.
PlaneEquations::PlaneBlock PlaneEquations::positive_inverse(const PlaneBlock& block) {
  Vec<3> scale = block.diagonal().cwiseAbs().cwiseSqrt();
  for (double& s : scale) s = s > 0.0 ? 1.0 / s : 1.0;
  const PlaneBlock scaled = scale.asDiagonal() * block * scale.asDiagonal();
  PlaneBlock inverse;
  if (const Eigen::LLT<PlaneBlock> factor(scaled); factor.info() == Eigen::Success) {
    inverse = factor.solve(PlaneBlock::Identity());
  } else {
    const Eigen::SelfAdjointEigenSolver<PlaneBlock> modes(scaled);
    const Vec<3> values = modes.eigenvalues().cwiseAbs().cwiseMax(kLeastStiffness);
    inverse = modes.eigenvectors() * values.cwiseInverse().asDiagonal() * modes.eigenvectors().transpose();
  }
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

/// Factorizes the matrix, with rows and columns multiplied by `scale`.
/// @param shift  receives the shift of the diagonal that made the matrix positive definite
bool PlaneEquations::factorize(const Eigen::VectorXd& scale, double& shift) {
  Eigen::SparseMatrix<double> scaled = matrix_;
  for (int c = 0; c < scaled.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(scaled, c); it; ++it)
      it.valueRef() *= scale[c] * scale[it.row()];
  factor_.set_matrix(scaled, group_);
  shift = kLeastShift;
  for (int trial = 0; trial < kMostShifts; ++trial) {
    if (factor_.factorize_positive(shift)) {
      if (shift > kLeastShift) last_shift_ = shift;
      return true;
    }
    shift = trial == 0 ? std::max(10.0 * kLeastShift, kFirstShift * last_shift_) : kNextShift * shift;
  }
  return false;
}

std::optional<PlaneStep> PlaneEquations::solve(const std::vector<SeparatingPlane>& planes) {
  Eigen::VectorXd scale(n_);
  for (int row = 0; row < n_; ++row)
    scale[row] = 1.0 / std::sqrt(std::max(std::abs(matrix_.coeff(row, row)), 1e-300));
  PlaneStep out;
  double shift = 0.0;
  if (!factorize(scale, shift)) return std::nullopt;
  out.is_convex = shift == kLeastShift;
  // This is the solution for the shifted matrix: there are no iterative refinements, which would remove the effect of
  // the shift.
  out.motion = scale.cwiseProduct(factor_.solve(scale.cwiseProduct(load_), 0).col(0));
  if (!out.motion.allFinite()) return std::nullopt;
  out.decrement = load_.dot(out.motion);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    PlaneVector& own = out.own.emplace_back(PlaneVector::Zero());
    for (int a = 0; a < kPairUnknowns; ++a)
      if (const int row = planes[k].unknown[a]; row >= 0) own[a] = out.motion[row];
    if (planes[k].is_wall) continue;
    const Eliminated& e = eliminated_[k];
    own.tail<kPlaneUnknowns>() = e.inverse * (e.load - e.coupling.transpose() * own.head<kPairUnknowns>());
    out.decrement += e.load.dot(e.inverse * e.load);
  }
  return out;
}

}  // namespace floc
