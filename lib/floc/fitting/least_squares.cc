#include "floc/fitting/least_squares.h"

#include <ceres/ceres.h>
#include <ceres/tiny_solver.h>
#include <glog/logging.h>

#include <limits>
#include <mutex>

#include "floc/base/dense_solvers.h"

namespace floc {
namespace {

/// Turns off the log messages of Ceres (written by glog).
void silence_ceres() {
  static std::once_flag once;
  std::call_once(once, [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    if (!google::IsGoogleLoggingInitialized()) google::InitGoogleLogging("floc");
  });
}

/// Cost function of Ceres that contains all residuals as one block.
class ResidualBlock final : public ceres::CostFunction {
 public:
  explicit ResidualBlock(const ResidualFunction& function) : function_(function) {
    set_num_residuals(function.n_residuals());
    mutable_parameter_block_sizes()->push_back(function.n_parameters());
  }
  bool Evaluate(const double* const* parameters, double* values, double** jacobians) const override {
    function_.evaluate(parameters[0], values, jacobians == nullptr ? nullptr : jacobians[0]);
    return true;
  }

 private:
  const ResidualFunction& function_;
};

/// Cost function in the form that Ceres' TinySolver requires. The number of parameters is given at run time: for each
/// number given at compile time, compilation would take ten seconds more.
class TinyFunction {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  explicit TinyFunction(const ResidualFunction& function)
      : function_(function), rows_(function.n_residuals(), function.n_parameters()) {}

  int NumResiduals() const { return function_.n_residuals(); }
  int NumParameters() const { return function_.n_parameters(); }
  bool operator()(const double* theta, double* values, double* jacobian) const {
    function_.evaluate(theta, values, jacobian == nullptr ? nullptr : rows_.data());
    if (jacobian != nullptr) Eigen::Map<Eigen::MatrixXd>(jacobian, rows_.rows(), rows_.cols()) = rows_;
    return true;
  }

 private:
  const ResidualFunction& function_;
  mutable Rows rows_;
};

/// Singular value decomposition of a Jacobian whose columns are scaled to unit length. `n_seen` singular values are not
/// rounding.
struct ScaledDecomposition {
  Eigen::VectorXd scale;
  SingularValues svd;
  Eigen::Index n_seen;

  explicit ScaledDecomposition(const Eigen::MatrixXd& jacobian) : scale(jacobian.colwise().norm()) {
    constexpr double kRounding = 1e-13;
    for (double& s : scale)
      if (s == 0.0) s = 1.0;
    svd = singular_values(jacobian * scale.cwiseInverse().asDiagonal());
    n_seen = (svd.values.array() > kRounding * svd.values[0]).count();
  }
  /// Returns the matrix H for which J H has orthonormal columns, and H H^T is (J^T J)^-1.
  Eigen::MatrixXd half() const {
    return scale.cwiseInverse().asDiagonal() * svd.right.leftCols(n_seen) *
           svd.values.head(n_seen).cwiseInverse().asDiagonal();
  }
};

}  // namespace

Eigen::MatrixXd unit_covariance(const Eigen::MatrixXd& jacobian) {
  const ScaledDecomposition decomposition(jacobian);
  const Eigen::MatrixXd half = decomposition.half();
  Eigen::MatrixXd covariance = half * half.transpose();
  const Eigen::MatrixXd& right = decomposition.svd.right;
  const Eigen::VectorXd unseen = right.rightCols(right.cols() - decomposition.n_seen).rowwise().squaredNorm();
  for (int k = 0; k < unseen.size(); ++k)
    if (unseen[k] > 1e-6) covariance(k, k) = std::numeric_limits<double>::infinity();
  return covariance;
}

Eigen::MatrixXd basis_of(const Eigen::MatrixXd& columns) {
  return columns * ScaledDecomposition(columns).half();
}

std::optional<LeastSquaresSolution> minimize(const ResidualFunction& function, const Eigen::VectorXd& start,
                                             const std::vector<ParameterLimits>& limits, int held) {
  const int n = function.n_residuals(), n_parameters = function.n_parameters();
  silence_ceres();
  LeastSquaresSolution found{start, {}, {}, 0.0};
  ceres::Problem problem;
  problem.AddResidualBlock(new ResidualBlock(function), nullptr, found.theta.data());
  for (const ParameterLimits& limit : limits) {
    double& x = found.theta[limit.parameter];
    x = std::clamp(x, limit.low, limit.high);
    problem.SetParameterLowerBound(found.theta.data(), limit.parameter, limit.low);
    problem.SetParameterUpperBound(found.theta.data(), limit.parameter, limit.high);
  }
  if (held >= 0) problem.SetManifold(found.theta.data(), new ceres::SubsetManifold(n_parameters, {held}));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  // The tolerances are as small as rounding. The problems are tiny, so this costs little. The solution has to be exact,
  // because the standard errors follow from the Jacobian at the solution.
  options.max_num_iterations = 400;
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-18;
  options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  double cost = 0.0;
  std::vector<double> values;
  ceres::CRSMatrix rows;
  if (!summary.IsSolutionUsable() || !problem.Evaluate({}, &cost, &values, nullptr, held < 0 ? &rows : nullptr))
    return std::nullopt;
  found.sum_of_squares = 2.0 * cost;
  found.residuals = Eigen::Map<Eigen::VectorXd>(values.data(), n);
  if (held < 0)
    found.jacobian = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        rows.values.data(), n, n_parameters);
  return found;
}

double descend(const ResidualFunction& function, Eigen::VectorXd& theta) {
  const TinyFunction tiny(function);
  ceres::TinySolver<TinyFunction> solver;
  solver.options.max_num_iterations = 100;
  solver.options.gradient_tolerance = 0.0;
  solver.options.parameter_tolerance = 1e-9;
  solver.options.function_tolerance = 1e-24;
  solver.options.cost_threshold = 1e-28;
  solver.Solve(tiny, &theta);
  return 2.0 * solver.summary.final_cost;
}

}  // namespace floc
