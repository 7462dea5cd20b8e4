#include "floc/fitting/consolidation_solver.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <mutex>

#include "floc/fitting/consolidation_law.h"

namespace floc {
namespace {

/// Ceres reports through glog; outcomes are returned in words instead.
void silence_ceres() {
  static std::once_flag once;
  std::call_once(once, [] {
    FLAGS_minloglevel = google::GLOG_FATAL;
    if (!google::IsGoogleLoggingInitialized()) google::InitGoogleLogging("floc");
  });
}

struct LogResidual {
  static constexpr int kParameters = 2;
  double log_P, log_P_first, y;
  template <class T>
  bool operator()(const T* theta, T* residual) const {
    using std::exp;
    residual[0] = theta[1] - exp(theta[0]) * (log_P - log_P_first) - y;
    return true;
  }
};

struct PowerResidual {
  static constexpr int kParameters = 3;
  double log_P, log_P_first, y;
  template <class T>
  bool operator()(const T* theta, T* residual) const {
    using std::exp;
    residual[0] = theta[2] + exp(theta[0] - exp(theta[1]) * log_P) - y;
    return true;
  }
};

struct FullResidual {
  static constexpr int kParameters = 4;
  double log_P, log_P_first, y;
  template <class T>
  bool operator()(const T* theta, T* residual) const {
    using std::exp;
    residual[0] = theta[2] - exp(theta[0]) * consolidation_bracket(T(log_P - theta[3]), T(exp(theta[1]))) - y;
    return true;
  }
};

struct Start {
  Eigen::VectorXd theta;
  double sum_of_squares;
};

/// Best intercept and slope of y = intercept + slope * x, and what they leave.
struct Line {
  double intercept, slope, sum_of_squares;
};

Line fit_line(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
  const Eigen::VectorXd dx = x.array() - x.mean();
  const Eigen::VectorXd dy = y.array() - y.mean();
  const double sxx = dx.squaredNorm();
  if (sxx == 0.0) return {y.mean(), 0.0, dy.squaredNorm()};
  const double slope = dx.dot(dy) / sxx;
  return {y.mean() - slope * x.mean(), slope, (dy - slope * dx).squaredNorm()};
}

/// `n` values from low to high, both included.
Eigen::VectorXd grid(double low, double high, int n) {
  return Eigen::VectorXd::LinSpaced(n, low, high);
}

// For given alpha (and P1*) the laws are linear in what remains: a start is a line through the data.

std::vector<Start> log_starts(const Eigen::VectorXd& log_P, const Eigen::VectorXd& y) {
  const Line line = fit_line(log_P.array() - log_P[0], y);
  if (line.slope >= 0.0) return {};
  return {{Eigen::Vector2d(std::log(-line.slope), line.intercept), line.sum_of_squares}};
}

std::vector<Start> power_starts(const Eigen::VectorXd& log_P, const Eigen::VectorXd& y) {
  std::vector<Start> starts;
  for (const double log_alpha : grid(std::log(0.1), std::log(8.0), 24)) {
    const Line line = fit_line((-std::exp(log_alpha) * log_P.array()).exp(), y);
    if (line.slope > 0.0)
      starts.push_back({Eigen::Vector3d(std::log(line.slope), log_alpha, line.intercept), line.sum_of_squares});
  }
  return starts;
}

std::vector<Start> full_starts(const Eigen::VectorXd& log_P, const Eigen::VectorXd& y) {
  std::vector<Start> starts;
  const double first = log_P[0];
  const double last = log_P[log_P.size() - 1];
  for (const double alpha_log : grid(std::log(0.2), std::log(6.0), 10))
    for (const double log_P1 : grid(first, last + 1.0, 16)) {
      const double alpha = std::exp(alpha_log);
      const Line line =
          fit_line(log_P.unaryExpr([&](double l) { return consolidation_bracket(l - log_P1, alpha); }), y);
      if (line.slope < 0.0)
        starts.push_back(
            {Eigen::Vector4d(std::log(-line.slope), alpha_log, line.intercept, log_P1), line.sum_of_squares});
    }
  return starts;
}

/// Covariance of the parameters from the Jacobian; a parameter with a part along a direction that the data do not see
/// has infinite variance.
Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& jacobian, double variance) {
  constexpr double kRounding = 1e-13;
  Eigen::VectorXd scale = jacobian.colwise().norm();
  for (double& s : scale)
    if (s == 0.0) s = 1.0;
  const Eigen::MatrixXd scaled = jacobian * scale.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  const Eigen::Index n_seen = (sigma.array() > kRounding * sigma[0]).count();
  const Eigen::MatrixXd half = scale.cwiseInverse().asDiagonal() * svd.matrixV().leftCols(n_seen) *
                               sigma.head(n_seen).cwiseInverse().asDiagonal();
  Eigen::MatrixXd covariance = variance * half * half.transpose();
  const Eigen::VectorXd unseen = svd.matrixV().rightCols(sigma.size() - n_seen).rowwise().squaredNorm();
  for (int k = 0; k < unseen.size(); ++k)
    if (unseen[k] > 1e-6) covariance(k, k) = std::numeric_limits<double>::infinity();
  return covariance;
}

template <class Residual>
std::optional<LawSolution> refine(const Eigen::VectorXd& log_P, const Eigen::VectorXd& y, const Start& start) {
  constexpr int kParameters = Residual::kParameters;
  Eigen::VectorXd theta = start.theta;
  ceres::Problem problem;
  for (int i = 0; i < y.size(); ++i)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<Residual, 1, kParameters>(new Residual{log_P[i], log_P[0], y[i]}),
        nullptr, theta.data());
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
  ceres::CRSMatrix rows;
  if (!summary.IsSolutionUsable() || !problem.Evaluate({}, &cost, nullptr, nullptr, &rows)) return std::nullopt;
  Eigen::MatrixXd jacobian(y.size(), kParameters);
  for (int i = 0; i < y.size(); ++i)
    for (int k = 0; k < kParameters; ++k)
      jacobian(i, k) = rows.values[static_cast<std::size_t>(i * kParameters + k)];
  const double variance = 2.0 * cost / static_cast<double>(y.size() - kParameters);
  return LawSolution{theta, covariance_of(jacobian, variance), 2.0 * cost};
}

/// Refines the best few starts and keeps the best end.
template <class Residual>
std::optional<LawSolution> best_of(const Eigen::VectorXd& log_P, const Eigen::VectorXd& y,
                                   std::vector<Start> starts) {
  constexpr std::size_t kRefined = 4;
  std::sort(starts.begin(), starts.end(),
            [](const Start& a, const Start& b) { return a.sum_of_squares < b.sum_of_squares; });
  starts.resize(std::min(starts.size(), kRefined));
  std::optional<LawSolution> best;
  for (const Start& start : starts) {
    auto solution = refine<Residual>(log_P, y, start);
    if (solution && (!best || solution->sum_of_squares < best->sum_of_squares)) best = std::move(solution);
  }
  return best;
}

}  // namespace

int n_parameters(ConsolidationLaw law) {
  return std::array{LogResidual::kParameters, PowerResidual::kParameters,
                    FullResidual::kParameters}[static_cast<std::size_t>(law)];
}

std::optional<LawSolution> solve_law(ConsolidationLaw law, const Eigen::VectorXd& log_P,
                                     const Eigen::VectorXd& y) {
  assert(log_P.size() == y.size() && y.size() > n_parameters(law));
  silence_ceres();
  switch (law) {
    case ConsolidationLaw::log:
      return best_of<LogResidual>(log_P, y, log_starts(log_P, y));
    case ConsolidationLaw::power:
      return best_of<PowerResidual>(log_P, y, power_starts(log_P, y));
    case ConsolidationLaw::full:
      return best_of<FullResidual>(log_P, y, full_starts(log_P, y));
  }
  return std::nullopt;
}

}  // namespace floc
