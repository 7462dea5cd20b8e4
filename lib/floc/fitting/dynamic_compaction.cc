#include "floc/fitting/dynamic_compaction.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "floc/base/dense_solvers.h"
#include "floc/fitting/least_squares.h"
#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

struct CompactionResidual {
  static constexpr int kParameters = 7;
  double log_p_crit, log_x, e;
  template <class T>
  T operator()(const T* theta) const {
    return compacted_void_ratio(theta, log_p_crit, log_x) - e;
  }
};

/// For given e_min and S the plateau is linear: e_r/(e - e_min) = 1/De + C ln(p_crit/p_D).
bool add_plateau(const std::vector<CompactionResidual>& data, Eigen::VectorXd& theta) {
  const auto n = static_cast<Eigen::Index>(data.size());
  Eigen::MatrixXd columns(n, 2);
  Eigen::VectorXd y(n);
  const double a = std::exp(theta[5]);
  const double b = a + std::exp(theta[6]);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CompactionResidual& r = data[static_cast<std::size_t>(i)];
    const double S = std::exp(theta[3] + a * r.log_x) + std::exp(theta[4] + b * r.log_x);
    // Weighted by the square of what it divides, so that errors count as they do in e.
    const double over = r.e - theta[0];
    const double e_r = S / (1.0 + S);
    columns.row(i) << over * over / e_r, over * over / e_r * r.log_p_crit;
    y[i] = over;
  }
  // Of many equal solutions, where p_crit does not vary, the smallest.
  const Eigen::Vector2d found = least_squares_solution(columns, y);
  if (!(found[0] > 0.0) || !found.allFinite()) return false;
  theta[1] = -std::log(found[0]);
  theta[2] = found[1];
  return true;
}

/// Starts over the range of e_min and of the crossover; those published in [SVI2024] are among them.
std::vector<Eigen::VectorXd> starts_of(const std::vector<CompactionResidual>& data) {
  const auto less = [](const auto& r, const auto& s) { return r.e < s.e; };
  const auto [low, high] = std::minmax_element(data.begin(), data.end(), less);
  std::vector<Eigen::VectorXd> starts;
  for (const double below : {0.01, 0.1, 0.4})
    for (const double a : {0.4, 0.74, 1.2})
      for (const double step : {0.6, 1.56})
        for (const double scale : {0.2, 1.0, 5.0}) {
          Eigen::VectorXd theta(7);
          theta << low->e - below * (high->e - low->e), 0.0, 0.0, std::log(0.475 * scale),
              std::log(0.17 * scale), std::log(a), std::log(step);
          if (add_plateau(data, theta)) starts.push_back(theta);
        }
  return starts;
}

/// The parameters as functions of theta: values, gradients, and how their intervals are made.
void add_parameters(const LeastSquaresSolution& solution, CompactionFit& fit) {
  const Eigen::VectorXd& t = solution.theta;
  const auto n = static_cast<int>(solution.residuals.size());
  const int dof = n - CompactionResidual::kParameters;
  const double variance = solution.sum_of_squares / dof;
  const Eigen::MatrixXd covariance = variance * unit_covariance(solution.jacobian);
  const double t95 = student_t_95(dof);
  const double A = std::exp(t[3]), rest = std::exp(t[4]), a = std::exp(t[5]), b = a + std::exp(t[6]);
  // Gradients of e_min, ln De, C, ln A, ln s_m, ln a, ln b.
  Eigen::MatrixXd G = Eigen::MatrixXd::Identity(7, 7);
  G.row(4) << 0, 0, 0, -A / (A + rest), -rest / (A + rest), 0, 0;
  G.row(6) << 0, 0, 0, 0, 0, a / b, 1.0 - a / b;
  const auto error = [&](int k) {
    double sum = 0.0;
    for (int i = 0; i < 7; ++i)
      for (int j = 0; j < 7; ++j)
        if (G(k, i) != 0.0 && G(k, j) != 0.0) sum += G(k, i) * covariance(i, j) * G(k, j);
    return std::sqrt(std::max(sum, 0.0));
  };
  fit.parameters = {from_value("e_min", t[0], error(0), t95),
                    from_logarithm("De", t[1], error(1), t95),
                    from_value("C", t[2], error(2), t95),
                    from_logarithm("A", t[3], error(3), t95),
                    from_logarithm("s_m", -std::log(A + rest), error(4), t95),
                    from_logarithm("a", t[5], error(5), t95),
                    from_logarithm("b", std::log(b), error(6), t95)};
  for (FittedParameter& p : fit.parameters) {
    if (p.identified) continue;
    fit.warnings.push_back(fmt::format("{} is not identified by these data", p.name));
    p.value = p.standard_error = std::nullopt;
  }
  const Eigen::MatrixXd c = G * covariance * G.transpose();
  const Eigen::VectorXd scale = c.diagonal().cwiseSqrt().cwiseInverse();
  fit.correlation = scale.asDiagonal() * c * scale.asDiagonal();
}

}  // namespace

CompactionFit fit_dynamic_compaction(const std::vector<CompactedSample>& samples,
                                     const CompactionReference& reference) {
  CompactionFit fit;
  const double p_0 = reference.p_0 > 0.0 ? reference.p_0 : reference.p_D;
  std::vector<CompactionResidual> data;
  for (int i = 0; i < static_cast<int>(samples.size()); ++i) {
    const CompactedSample& s = samples[static_cast<std::size_t>(i)];
    const double p_crit = s.sc * s.sc / s.se;
    // A sample typed with a few digits at p_0 is meant to be taken.
    if (p_crit < p_0 * (1 - 1e-6)) continue;
    data.push_back(
        {std::log(p_crit / reference.p_D), std::log(s.sc / std::sqrt(s.p * s.se) / reference.eta_m), s.e});
    fit.used.push_back(i);
  }
  if (fit.used.size() < samples.size())
    fit.warnings.push_back(
        fmt::format("{} of the {} samples have p_crit = sc^2/se below {:.4g} and are left out",
                    samples.size() - fit.used.size(), samples.size(), p_0));
  if (data.size() <= CompactionResidual::kParameters) {
    fit.refusal = fmt::format("{} samples with p_crit >= {:.4g}, the law needs {}", data.size(), p_0,
                              CompactionResidual::kParameters + 1);
    return fit;
  }
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::VectorXd theta : starts_of(data)) {
    const double left = descend(data, theta);
    if (left < least && theta.allFinite()) least = left, best = theta;
  }
  const auto solution = best.size() > 0 ? minimize(data, best) : std::nullopt;
  if (!solution) {
    fit.refusal = "no start leads to a solution: the void ratio does not follow the law";
    return fit;
  }
  fit.rms = std::sqrt(solution->sum_of_squares / static_cast<double>(data.size()));
  add_parameters(*solution, fit);
  return fit;
}

}  // namespace floc
