#include "floc/fitting/scattering_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "floc/base/error.h"
#include "floc/fitting/least_squares.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

constexpr int kMinBins = 6;
/// If chi squared per degree of freedom is above this value, a warning says that the data do not follow the law.
constexpr double kFarOff = 9.0;

/// Residual of ln I in one bin of wave numbers, divided by the standard deviation of ln I, where I is the scattered
/// intensity. theta consists of ln I0, ln xi and dF, see ScatteringFit.
struct ScatteringResidual {
  static constexpr int kParameters = 3;
  double k, log_I, weight;
  template <class T>
  T operator()(const T* theta) const {
    using std::exp;
    using std::log;
    const T x = exp(theta[1]) * (k / (2.0 * std::numbers::pi));
    return weight * (log_I - theta[0] + 0.5 * theta[2] * log(1.0 + x * x));
  }
};

/// Returns the bias of the logarithm of an intensity that is an average over n wave vectors: digamma(n) - ln n. This is
/// the mean of ln X, where X is the average of n exponential random variables of mean 1. digamma(n) is computed by
/// Abramowitz and Stegun 6.3.18, after the recurrence of digamma has increased a small n.
double log_bias(double n) {
  double shift = 0.0, m = n;
  for (; m < 6.0; m += 1.0) shift -= 1.0 / m;
  return shift + std::log(m) - 0.5 / m - 1.0 / (12.0 * m * m) + 1.0 / (120.0 * m * m * m * m) - std::log(n);
}

std::vector<ScatteringResidual> residuals_of(const std::vector<ScatteredPoint>& points, double low,
                                             double high) {
  std::vector<ScatteringResidual> data;
  for (const ScatteredPoint& p : points) {
    if (p.k < low || p.k > high || !(p.I > 0.0)) continue;
    const auto n = static_cast<double>(p.n_vectors);
    data.push_back({p.k, std::log(p.I) - log_bias(n), std::sqrt(n)});
  }
  return data;
}

/// Fits the scattering law from several starting points, and returns the best solution. The length xi of a starting
/// point is the wavelength of any of the bins.
std::optional<LeastSquaresSolution> solve(const std::vector<ScatteringResidual>& data) {
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (const ScatteringResidual& at : data)
    for (const double dF : {1.0, 1.7, 2.5}) {
      Eigen::VectorXd theta(3);
      theta << data.front().log_I, std::log(2.0 * std::numbers::pi / at.k), dF;
      const double left = descend(data, theta);
      if (left < least && theta.allFinite()) least = left, best = theta;
    }
  if (best.size() == 0) return std::nullopt;
  return minimize(data, best);
}

}  // namespace

double scattered_intensity(double I0, double xi, double dF, double k) {
  const double x = k * xi / (2.0 * std::numbers::pi);
  return I0 * std::pow(1.0 + x * x, -0.5 * dF);
}

ScatteringFit fit_scattering(const std::vector<ScatteredPoint>& points, double low, double high) {
  if (!(low < high) || !std::isfinite(low) || !std::isfinite(high))
    throw InputError(
        "", fmt::format(
                "fit_range = {},{}: the range of wave numbers must be two finite numbers, the lower one first",
                low, high));
  ScatteringFit fit;
  const std::vector<ScatteringResidual> data = residuals_of(points, low, high);
  fit.n_points = static_cast<int>(data.size());
  if (fit.n_points < kMinBins) {
    fit.failure_reason = fmt::format(
        "there are {} bins of wave numbers k between {:.4g} and {:.4g}, but a fit of the law needs {}",
        fit.n_points, low, high, kMinBins);
    return fit;
  }
  fit.low = data.front().k;
  fit.high = data.back().k;
  const auto solution = solve(data);
  if (!solution) {
    fit.failure_reason =
        "the fit finds no solution from any starting point: the intensity does not follow the law";
    return fit;
  }
  const int dof = fit.n_points - ScatteringResidual::kParameters;
  fit.chi_square = solution->sum_of_squares / dof;
  double sum = 0.0;
  for (int i = 0; i < fit.n_points; ++i) sum += std::pow(solution->residuals[i] / data[i].weight, 2);
  fit.rms = std::sqrt(sum / fit.n_points);
  const Eigen::MatrixXd covariance = std::max(1.0, fit.chi_square) * unit_covariance(solution->jacobian);
  const auto error = [&](int k) { return std::sqrt(covariance(k, k)); };
  const double t95 = student_t_95(dof);
  fit.parameters = {from_logarithm("I0", solution->theta[0], error(0), t95),
                    from_logarithm("xi", solution->theta[1], error(1), t95),
                    from_value("dF", solution->theta[2], error(2), t95)};
  // The exponent dF is minus the slope of ln I against ln k at wavelengths below the length xi. The exponent has no
  // meaning if the data do not determine xi.
  fit.parameters[2].identified = fit.parameters[1].identified;
  const double xi = *fit.parameters[1].value;
  if (xi * fit.low > 2.0 * std::numbers::pi)
    fit.warnings.push_back(
        fmt::format("the intensity does not level off at small k: the length xi = {:.4g} is larger than the "
                    "largest wavelength fitted, {:.4g}",
                    xi, 2.0 * std::numbers::pi / fit.low));
  if (xi * fit.high < 4.0 * std::numbers::pi)
    fit.warnings.push_back(
        "hardly any fitted wavelengths lie below the length xi, so that the fractal dimension dF is not "
        "reliable");
  if (fit.chi_square > kFarOff)
    fit.warnings.push_back(
        fmt::format("the intensity does not follow the law: its residuals are {:.3g} times as large as the "
                    "scatter of speckles",
                    std::sqrt(fit.chi_square)));
  for (FittedParameter& p : fit.parameters) {
    if (p.identified) continue;
    fit.warnings.push_back(fmt::format("{} is not identified by these data", p.name));
    p.value = p.standard_error = p.low95 = p.high95 = std::nullopt;
  }
  // Largest possible dF, by Porod's law: the intensity falls most steeply for smooth surfaces in 3D, as k^-4.
  constexpr double kPorod = 4.0;
  if (const std::string beyond = keep_in_range({0.0, kPorod}, fit.parameters[2]); !beyond.empty())
    fit.warnings.push_back(beyond);
  return fit;
}

}  // namespace floc
