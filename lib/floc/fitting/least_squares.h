#pragma once

#include <ceres/ceres.h>
#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>
#include <glog/logging.h>

#include <Eigen/Dense>
#include <algorithm>
#include <mutex>
#include <optional>
#include <vector>

namespace floc {

/// A minimum of a sum of squares.
struct LeastSquaresSolution {
  Eigen::VectorXd theta;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;  ///< residuals x parameters; empty when a parameter was held
  double sum_of_squares = 0.0;
};

/// Range that a parameter may not leave.
struct ParameterLimits {
  int parameter;
  double low, high;
};

/// (J^T J)^-1, parameters x parameters; a parameter with a part along a direction that the data do not see has
/// infinite variance.
[[nodiscard]] Eigen::MatrixXd unit_covariance(const Eigen::MatrixXd& jacobian);

/// Ceres reports through glog; outcomes are returned in words instead.
inline void silence_ceres() {
  static std::once_flag once;
  std::call_once(once, [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    if (!google::IsGoogleLoggingInitialized()) google::InitGoogleLogging("floc");
  });
}

/// All residuals as one block of a Ceres problem.
template <class Residual>
struct ResidualBlock {
  const std::vector<Residual>& residuals;
  int NumResiduals() const { return static_cast<int>(residuals.size()); }
  template <class T>
  bool operator()(const T* theta, T* values) const {
    for (const Residual& residual : residuals) *values++ = residual(theta);
    return true;
  }
};

/// Least squares by Levenberg-Marquardt (Ceres), to rounding, from one start.
/// @param residuals  each with `kParameters` and `T operator()(const T* theta)` on any scalar
/// @param limits     of the parameters, where there are any
/// @param held       index of a parameter kept at its start; -1 for none
/// Absent if the solver fails.
template <class Residual>
[[nodiscard]] std::optional<LeastSquaresSolution> minimize(const std::vector<Residual>& residuals,
                                                           const Eigen::VectorXd& start,
                                                           const std::vector<ParameterLimits>& limits = {},
                                                           int held = -1) {
  constexpr int kParameters = Residual::kParameters;
  silence_ceres();
  LeastSquaresSolution found{start, {}, {}, 0.0};
  ceres::Problem problem;
  using Block = ResidualBlock<Residual>;
  const auto n = static_cast<int>(residuals.size());
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<Block, ceres::DYNAMIC, kParameters>(new Block{residuals}, n), nullptr,
      found.theta.data());
  for (const ParameterLimits& limit : limits) {
    double& x = found.theta[limit.parameter];
    x = std::clamp(x, limit.low, limit.high);
    problem.SetParameterLowerBound(found.theta.data(), limit.parameter, limit.low);
    problem.SetParameterUpperBound(found.theta.data(), limit.parameter, limit.high);
  }
  if (held >= 0) problem.SetManifold(found.theta.data(), new ceres::SubsetManifold(kParameters, {held}));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  // Down to rounding: problems are tiny, and errors are read off the Jacobian at the solution.
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
    found.jacobian = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, kParameters, Eigen::RowMajor>>(
        rows.values.data(), n, kParameters);
  return found;
}

/// The same by normal equations (Ceres' TinySolver): ten times faster, good to half the digits, for searches
/// among starts.
/// @return the sum of squares reached; `theta` is the start, then the end. It may be NaN.
template <class Residual>
double descend(const std::vector<Residual>& residuals, Eigen::VectorXd& theta) {
  using Block = ResidualBlock<Residual>;
  using Function = ceres::TinySolverAutoDiffFunction<Block, Eigen::Dynamic, Residual::kParameters>;
  const Block block{residuals};
  const Function function(block);
  ceres::TinySolver<Function> solver;
  solver.options.max_num_iterations = 100;
  solver.options.gradient_tolerance = 0.0;
  solver.options.parameter_tolerance = 1e-9;
  solver.options.function_tolerance = 1e-24;
  solver.options.cost_threshold = 1e-28;
  typename ceres::TinySolver<Function>::Parameters x = theta;
  solver.Solve(function, &x);
  theta = x;
  return 2.0 * solver.summary.final_cost;
}

}  // namespace floc
