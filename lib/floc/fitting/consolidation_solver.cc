#include "floc/fitting/consolidation_solver.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "floc/fitting/consolidation_law.h"
#include "floc/fitting/least_squares.h"
#include "floc/fitting/line_fit.h"

namespace floc {
namespace {

struct LogResidual {
  static constexpr int kParameters = 2;
  double log_P, log_P_first, y, weight;
  template <class T>
  T operator()(const T* theta) const {
    using std::exp;
    return weight * (theta[1] - exp(theta[0]) * (log_P - log_P_first) - y);
  }
};

struct PowerResidual {
  static constexpr int kParameters = 3;
  double log_P, log_P_first, y, weight;
  template <class T>
  T operator()(const T* theta) const {
    using std::exp;
    return weight * (theta[2] + exp(theta[0] - exp(theta[1]) * (log_P - log_P_first)) - y);
  }
};

struct FullResidual {
  static constexpr int kParameters = 4;
  double log_P, log_P_first, y, weight;
  template <class T>
  T operator()(const T* theta) const {
    using std::exp;
    return weight *
           (theta[2] - exp(theta[0]) * consolidation_bracket(T(log_P - theta[3]), T(exp(theta[1]))) - y);
  }
};

struct Start {
  Eigen::VectorXd theta;
  double sum_of_squares;
};

using Line = WeightedLine;

Line fit_line(const Eigen::VectorXd& x, const LawPoints& points) {
  return fit_weighted_line(x, points.y, points.weight);
}

/// Returns `n` equidistant values from low to high, both included.
Eigen::VectorXd grid(double low, double high, int n) {
  return Eigen::VectorXd::LinSpaced(n, low, high);
}

// If the exponent alpha and, in the full law, P1* are given, the consolidation laws are linear in the other parameters.
// A straight line fitted to the data therefore gives a starting point of the solver.

std::vector<Start> log_starts(const LawPoints& points) {
  const Line line = fit_line(points.log_P.array() - points.log_P[0], points);
  if (line.slope >= 0.0) return {};
  return {{Eigen::Vector2d(std::log(-line.slope), line.intercept), line.sum_of_squares}};
}

Line power_line(const LawPoints& points, double log_alpha) {
  return fit_line((-std::exp(log_alpha) * (points.log_P.array() - points.log_P[0])).exp(), points);
}

std::vector<Start> power_starts(const LawPoints& points) {
  std::vector<Start> starts;
  for (const double log_alpha : grid(std::log(0.1), std::log(8.0), 24)) {
    const Line line = fit_line((-std::exp(log_alpha) * (points.log_P.array() - points.log_P[0])).exp(), points);
    if (line.slope > 0.0)
      starts.push_back({Eigen::Vector3d(std::log(line.slope), log_alpha, line.intercept), line.sum_of_squares});
  }
  return starts;
}

std::vector<Start> full_starts(const LawPoints& points) {
  std::vector<Start> starts;
  const Eigen::VectorXd& log_P = points.log_P;
  const double first = log_P[0];
  const double end = log_P[log_P.size() - 1] + 1.0;
  // The starting values of ln P1* are at most about 0.5 apart, which is close enough to find the minimum.
  const int n_P1 = std::clamp(static_cast<int>(std::ceil((end - first) / 0.5)) + 1, 16, 128);
  for (const double alpha_log : grid(std::log(0.2), std::log(6.0), 10))
    for (const double log_P1 : grid(first, end, n_P1)) {
      const double alpha = std::exp(alpha_log);
      const Line line =
          fit_line(log_P.unaryExpr([&](double l) { return consolidation_bracket(l - log_P1, alpha); }), points);
      if (line.slope < 0.0)
        starts.push_back(
            {Eigen::Vector4d(std::log(-line.slope), alpha_log, line.intercept, log_P1), line.sum_of_squares});
    }
  return starts;
}

template <class Residual>
std::vector<Residual> residuals_of(const LawPoints& points) {
  std::vector<Residual> residuals;
  for (int i = 0; i < points.size(); ++i)
    residuals.push_back({points.log_P[i], points.log_P[0], points.y[i], points.weight[i]});
  return residuals;
}

/// Returns limits of the parameters alpha and P1*, which could diverge without limits. The limits are so wide that the
/// consolidation laws have reached their limiting forms.
std::vector<ParameterLimits> limits_of(int n_parameters, const LawPoints& points) {
  constexpr double kFar = 15.0;
  std::vector<ParameterLimits> limits;
  if (n_parameters > 2) limits.push_back({1, std::log(1e-2), std::log(1e2)});
  if (n_parameters > 3) limits.push_back({3, points.log_P[0] - kFar, points.log_P[points.size() - 1] + kFar});
  return limits;
}

bool within(const std::vector<ParameterLimits>& limits, const Eigen::VectorXd& theta) {
  return std::all_of(limits.begin(), limits.end(), [&](const ParameterLimits& limit) {
    return limit.low <= theta[limit.parameter] && theta[limit.parameter] <= limit.high;
  });
}

template <class Residual>
std::optional<LawSolution> refine(const LawPoints& points, const Eigen::VectorXd& start, int held) {
  const std::vector<Residual> residuals = residuals_of<Residual>(points);
  std::vector<ParameterLimits> limits = limits_of(Residual::kParameters, points);
  auto found = minimize(residuals, start, {}, held);
  // The solver is less accurate if the parameters have limits. It therefore runs without limits first. If this run
  // fails or ends beyond the limits, the solver runs again with limits.
  if (!found || !within(limits, found->theta)) found = minimize(residuals, start, limits, held);
  if (!found) return std::nullopt;
  const bool beyond = Residual::kParameters > kLimitParameter && held != kLimitParameter &&
                      found->theta[kLimitParameter] < points.least_limit;
  if (beyond) {
    limits.push_back({kLimitParameter, points.least_limit, std::numeric_limits<double>::max()});
    found = minimize(residuals, found->theta, limits, held);
    if (!found) return std::nullopt;
  }
  return LawSolution{std::move(found->theta), std::move(found->residuals), std::move(found->jacobian),
                     found->sum_of_squares, beyond};
}

std::vector<Start> starts_of(ConsolidationLaw law, const LawPoints& points) {
  switch (law) {
    case ConsolidationLaw::log:
      return log_starts(points);
    case ConsolidationLaw::power:
      return power_starts(points);
    case ConsolidationLaw::full:
      return full_starts(points);
  }
  return {};
}

}  // namespace

int n_parameters(ConsolidationLaw law) {
  return std::array{LogResidual::kParameters, PowerResidual::kParameters,
                    FullResidual::kParameters}[static_cast<std::size_t>(law)];
}

std::optional<double> residual_of_line(const LawPoints& points) {
  const Line line = fit_line(points.log_P, points);
  return line.slope < 0.0 ? std::optional(line.sum_of_squares) : std::nullopt;
}

std::optional<double> residual_of_power_law(const LawPoints& points) {
  const auto left = [&](double log_alpha) {
    const Line line = power_line(points, log_alpha);
    return line.slope > 0.0 ? line.sum_of_squares : std::numeric_limits<double>::infinity();
  };
  const Eigen::VectorXd places = grid(std::log(0.1), std::log(8.0), 12);
  Eigen::Index best = 0;
  places.unaryExpr(left).minCoeff(&best);
  // Golden-section search for the best ln alpha between the neighbours of the best grid point.
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kRounds = 20;
  double low = places[std::max<Eigen::Index>(best - 1, 0)];
  double high = places[std::min(best + 1, places.size() - 1)];
  double inner = high - kGolden * (high - low), outer = low + kGolden * (high - low);
  double left_inner = left(inner), left_outer = left(outer);
  for (int round = 0; round < kRounds; ++round) {
    if (left_inner < left_outer) {
      high = std::exchange(outer, inner);
      left_outer = left_inner;
      left_inner = left(inner = high - kGolden * (high - low));
    } else {
      low = std::exchange(inner, outer);
      left_inner = left_outer;
      left_outer = left(outer = low + kGolden * (high - low));
    }
  }
  const double least = std::min(left_inner, left_outer);
  return std::isfinite(least) ? std::optional(least) : std::nullopt;
}

double law_value(ConsolidationLaw law, const Eigen::VectorXd& theta, double log_P, double log_P_first) {
  const double* t = theta.data();
  switch (law) {
    case ConsolidationLaw::log:
      return LogResidual{log_P, log_P_first, 0.0, 1.0}(t);
    case ConsolidationLaw::power:
      return PowerResidual{log_P, log_P_first, 0.0, 1.0}(t);
    case ConsolidationLaw::full:
      return FullResidual{log_P, log_P_first, 0.0, 1.0}(t);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<LawSolution> solve_law_from(ConsolidationLaw law, const LawPoints& points,
                                          const Eigen::VectorXd& start, int held) {
  switch (law) {
    case ConsolidationLaw::log:
      return refine<LogResidual>(points, start, held);
    case ConsolidationLaw::power:
      return refine<PowerResidual>(points, start, held);
    case ConsolidationLaw::full:
      return refine<FullResidual>(points, start, held);
  }
  return std::nullopt;
}

double minimize_law(ConsolidationLaw law, const LawPoints& points, Eigen::VectorXd& theta) {
  switch (law) {
    case ConsolidationLaw::log:
      return descend(residuals_of<LogResidual>(points), theta);
    case ConsolidationLaw::power:
      return descend(residuals_of<PowerResidual>(points), theta);
    case ConsolidationLaw::full:
      return descend(residuals_of<FullResidual>(points), theta);
  }
  return std::numeric_limits<double>::infinity();
}

std::optional<Eigen::VectorXd> start_of_law(ConsolidationLaw law, const LawPoints& points, int n_tried) {
  std::vector<Start> starts = starts_of(law, points);
  const auto less = [](const Start& a, const Start& b) { return a.sum_of_squares < b.sum_of_squares; };
  std::sort(starts.begin(), starts.end(), less);
  starts.resize(std::min(starts.size(), static_cast<std::size_t>(n_tried)));
  const std::vector<ParameterLimits> limits = limits_of(n_parameters(law), points);
  for (Start& start : starts) {
    Eigen::VectorXd end = start.theta;
    const double left = minimize_law(law, points, end);
    // A solution beyond the limits of alpha and P1* does not replace the starting point: from such a solution, the
    // solver would not reach a minimum within the limits.
    if (left < start.sum_of_squares && within(limits, end)) start = {end, left};
  }
  const auto best = std::min_element(starts.begin(), starts.end(), less);
  return best == starts.end() ? std::nullopt : std::optional(best->theta);
}

std::optional<LawSolution> solve_law(ConsolidationLaw law, const LawPoints& points) {
  assert(points.log_P.size() == points.y.size() && points.size() > n_parameters(law));
  constexpr int kTried = 4;
  const auto start = start_of_law(law, points, kTried);
  return start ? solve_law_from(law, points, *start) : std::nullopt;
}

}  // namespace floc
