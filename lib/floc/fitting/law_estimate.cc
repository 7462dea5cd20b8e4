#include "floc/fitting/law_estimate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floc/fitting/least_squares.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

using Law = ConsolidationLaw;

/// Variance of weighted residuals, and its number of degrees of freedom.
struct ResidualVariance {
  double variance;
  int dof;
};

ResidualVariance residuals_of_law(const LawEstimate& e) {
  const int dof = e.points.size() - static_cast<int>(e.solution.theta.size());
  return {e.solution.sum_of_squares / dof, dof};
}

/// Returns the variance of the residuals in one part of the data: the points before the law, or the points of the law.
/// Returns `own`, the variance from this part alone, if it has enough degrees of freedom, because the errors may differ
/// between the parts. Returns `own` also if a level line was fitted to the plateau, because the residuals of a sloping
/// plateau from a level line are not noise. Otherwise, returns the common variance of both parts.
ResidualVariance shared_variance(const LawEstimate& e, const ResidualVariance& own) {
  constexpr int kEnough = 6;
  if (!e.line.slopes || own.dof >= kEnough) return own;
  const ResidualVariance law = residuals_of_law(e);
  const int dof = law.dof + e.plateau.size() - 2;
  return {(law.variance * law.dof + e.line.sum_of_squares) / dof, dof};
}

ResidualVariance variance_of_law(const LawEstimate& e) {
  return shared_variance(e, residuals_of_law(e));
}

ResidualVariance variance_of_line(const LawEstimate& e) {
  const int dof = e.plateau.size() - 2;
  return shared_variance(e, {dof > 0 ? e.line.sum_of_squares / dof : 0.0, dof});
}

/// Returns (J^T J)^-1 of the law, where J is the Jacobian of the weighted residuals. If 1/Phi_max is at its bound, it
/// counts as given, not fitted.
Eigen::MatrixXd unit_covariance_of(const LawSolution& solution) {
  if (!solution.at_limit) return unit_covariance(solution.jacobian);
  Eigen::MatrixXd jacobian = solution.jacobian;
  jacobian.col(kLimitParameter).setZero();
  Eigen::MatrixXd c = unit_covariance(jacobian);
  c.row(kLimitParameter).setZero();
  c.col(kLimitParameter).setZero();
  return c;
}

/// Returns the gradient of coordinate `k` with respect to all `n` coordinates: a unit vector.
Eigen::VectorXd unit(Eigen::Index n, Eigen::Index k) {
  return Eigen::VectorXd::Unit(n, k);
}

/// Adds Phi0 and P0*, the solid fraction and the reduced pressure at which the line of regime II begins, with their
/// gradients. The line of regime II begins where it meets the plateau or the recompression line before it. If there is
/// no such plateau or line, the line of regime II begins at the first pressure, and only Phi0 is added.
///
/// @param log_P, y  ln P* and 1/Phi of a point on the line of regime II
/// @param to_log_P, to_y  gradients of log_P and y with respect to the coordinates of the fit
void add_start_of_regime_two(const LawEstimate& e, double log_P, const Eigen::VectorXd& to_log_P, double y,
                             const Eigen::VectorXd& to_y, std::vector<Quantity>& quantities) {
  const double lambda = std::exp(e.solution.theta[0]);
  const Eigen::Index n = to_y.size();
  if (e.has_plateau()) {
    // The line of regime II and the line before it meet at ln P0* = log_P + drop, where y - lambda drop = line.at(log_P
    // + drop).
    const double steeper = lambda - e.line.kappa;
    const double drop = (y - e.line.at(log_P)) / steeper;
    const double log_P0 = log_P + drop;
    const Eigen::VectorXd to_level = unit(n, e.solution.theta.size());
    Eigen::VectorXd to_log_P0 =
        to_log_P * (1.0 + e.line.kappa / steeper) + (to_y - to_level - lambda * drop * unit(n, 0)) / steeper;
    Eigen::VectorXd to_y0 = to_level;
    if (e.line.slopes) {
      const Eigen::VectorXd to_kappa = unit(n, n - 1);
      to_log_P0 += (log_P0 - e.line.centre) / steeper * to_kappa;
      to_y0 -= (log_P0 - e.line.centre) * to_kappa + e.line.kappa * to_log_P0;
    }
    quantities.push_back({"Phi0", true, e.line.at(log_P0), to_y0});
    quantities.push_back({"P0_star", false, log_P0, to_log_P0});
    return;
  }
  const double distance = e.points.log_P[0] - log_P;
  quantities.push_back(
      {"Phi0", true, y - lambda * distance, to_y + lambda * to_log_P - lambda * distance * unit(n, 0)});
}

/// Returns, for each point of the recompression line, the distance in ln P* from the centre of the line, multiplied by
/// the weight of the point.
Eigen::VectorXd weighted_distances(const LawEstimate& e) {
  return e.plateau.weight.array() * (e.plateau.log_P.array() - e.line.centre);
}

/// Returns the profile of the sum of squares: a function that fixes the coordinate at a given value, fits the other
/// coordinates, and returns the sum of squares. Each call starts from the solution of the previous call.
ProfileFunction profile_of(const LawEstimate& estimate, int coordinate) {
  return [&estimate, coordinate, theta = estimate.solution.theta](double value) mutable {
    Eigen::VectorXd start = theta;
    start[coordinate] = value;
    const auto solution = solve_law_from(estimate.law, estimate.points, start, coordinate);
    if (!solution) return std::numeric_limits<double>::infinity();
    theta = solution->theta;
    return solution->sum_of_squares;
  };
}

}  // namespace

Eigen::VectorXd at_first_pressure(Law law, Eigen::VectorXd theta, double step) {
  if (law == Law::log) theta[1] -= std::exp(theta[0]) * step;
  if (law == Law::power) theta[0] -= std::exp(theta[1]) * step;
  return theta;
}

double Quantity::parameter() const {
  return is_inverse ? 1.0 / value : std::exp(value);
}

std::vector<Quantity> quantities_of(const LawEstimate& e) {
  const Eigen::VectorXd& theta = e.solution.theta;
  const Eigen::Index n = e.n_coordinates();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(n);
  const double first = e.points.log_P[0];
  std::vector<Quantity> found;
  // Each parameter is a function of the coordinates (see LawSolution). fitted_parameter() needs the gradient of this
  // function to compute the standard error. P0* and Phi0 follow from the other parameters and the plateau.
  switch (e.law) {
    case Law::log:
      found.push_back({"lambda", false, theta[0], unit(n, 0), true});
      add_start_of_regime_two(e, first, none, theta[1], unit(n, 1), found);
      break;
    case Law::power: {
      // theta contains the logarithm of A1 = A P_first^-alpha, so that ln A = ln A1 + alpha ln P_first.
      const double alpha = std::exp(theta[1]);
      found.push_back({"A", false, theta[0] + alpha * first, unit(n, 0) + alpha * first * unit(n, 1)});
      found.push_back({"alpha", false, theta[1], unit(n, 1)});
      found.push_back({"Phi_max", true, theta[2], unit(n, 2)});
      break;
    }
    case Law::full:
      found.push_back({"lambda", false, theta[0], unit(n, 0)});
      found.push_back({"alpha", false, theta[1], unit(n, 1)});
      found.push_back({"Phi_max", true, theta[2], unit(n, 2)});
      found.push_back({"P1_star", false, theta[3], unit(n, 3)});
      add_start_of_regime_two(e, theta[3], unit(n, 3), theta[2], unit(n, 2), found);
      break;
  }
  return found;
}

Covariance covariance_from_residuals(const LawEstimate& e) {
  const Eigen::Index n = e.solution.theta.size();
  const auto [variance, dof] = variance_of_law(e);
  Covariance c{Eigen::MatrixXd::Zero(e.n_coordinates(), e.n_coordinates()), dof};
  c.matrix.topLeftCorner(n, n) = variance * unit_covariance_of(e.solution);
  if (!e.has_plateau()) return c;
  const double of_line = e.line.slopes ? variance_of_line(e).variance : variance;
  c.matrix(n, n) = of_line / e.plateau.weight.squaredNorm();
  if (e.line.slopes) c.matrix(n + 1, n + 1) = of_line / weighted_distances(e).squaredNorm();
  return c;
}

Covariance covariance_from_samples(const LawEstimate& e, const Eigen::MatrixXd& deviations) {
  const Eigen::Index n_plateau = e.plateau.size();
  const Eigen::Index n_window = e.points.size();
  assert(deviations.rows() == n_plateau + n_window && deviations.cols() >= 2);
  const Eigen::Index n = e.solution.theta.size();
  const Eigen::MatrixXd unscaled = unit_covariance_of(e.solution);
  Eigen::MatrixXd finite = unscaled;
  for (Eigen::Index k = 0; k < n; ++k)
    if (!std::isfinite(finite(k, k))) finite.row(k).setZero(), finite.col(k).setZero();
  // Change of each coordinate of the fit (rows) due to the deviation of each sample from the mean (columns).
  Eigen::MatrixXd change(e.n_coordinates(), deviations.cols());
  change.topRows(n) =
      finite * e.solution.jacobian.transpose() * e.points.weight.asDiagonal() * deviations.bottomRows(n_window);
  if (n_plateau > 0) {
    const Eigen::VectorXd w2 = e.plateau.weight.array().square();
    change.row(n) = w2.transpose() * deviations.topRows(n_plateau) / w2.sum();
  }
  if (e.line.slopes) {
    const Eigen::VectorXd d = weighted_distances(e);
    change.row(n + 1) =
        -d.cwiseProduct(e.plateau.weight).transpose() * deviations.topRows(n_plateau) / d.squaredNorm();
  }
  const auto m = static_cast<double>(deviations.cols());
  Covariance c{change * change.transpose() / (m * (m - 1.0)), static_cast<int>(deviations.cols()) - 1, true};
  for (Eigen::Index k = 0; k < n; ++k)
    if (!std::isfinite(unscaled(k, k))) c.matrix(k, k) = unscaled(k, k);
  return c;
}

FittedParameter fitted_parameter(const Quantity& quantity, const Covariance& covariance) {
  double variance = 0.0;
  // Coordinates on which the parameter does not depend are left out, because their variance may be infinite.
  for (int i = 0; i < quantity.gradient.size(); ++i)
    for (int j = 0; j < quantity.gradient.size(); ++j)
      if (quantity.gradient[i] != 0.0 && quantity.gradient[j] != 0.0)
        variance += quantity.gradient[i] * covariance.matrix(i, j) * quantity.gradient[j];
  const double error = std::sqrt(std::max(variance, 0.0));
  const double t95 = student_t_95(covariance.dof);
  if (quantity.is_inverse) return from_inverse(quantity.name, quantity.value, error, t95);
  FittedParameter p = from_logarithm(quantity.name, quantity.value, error, t95);
  if (!covariance.is_of_samples || !quantity.is_mean) return p;
  // Student's interval of a mean is symmetric about the mean. A negative lower end is raised to 0, because the
  // parameter is positive.
  p.low95 = std::max(0.0, *p.value - t95 * *p.standard_error);
  p.high95 = *p.value + t95 * *p.standard_error;
  return p;
}

FittedParameter kappa_of(const LawEstimate& e, const Covariance& covariance) {
  const Eigen::Index last = e.n_coordinates() - 1;
  FittedParameter kappa =
      from_value("kappa", e.line.kappa, std::sqrt(covariance.matrix(last, last)), student_t_95(covariance.dof));
  for (auto* number : {&kappa.value, &kappa.low95, &kappa.high95}) *number = std::max(0.0, **number);
  return kappa;
}

ProfileInterval profile_interval(const LawEstimate& estimate, int coordinate, const Covariance& covariance) {
  const double center = estimate.solution.theta[coordinate];
  const double t95 = student_t_95(covariance.dof);
  const double error = std::sqrt(covariance.matrix(coordinate, coordinate));
  // If the standard error is below this limit, changes of the sum of squares are only rounding, and the interval is
  // computed from the covariance.
  constexpr double kRounding = 1e-9;
  const bool is_at_limit = coordinate == kLimitParameter && estimate.solution.at_limit;
  if (error < kRounding && !is_at_limit) return {center - t95 * error, center + t95 * error};
  const Covariance own = covariance_from_residuals(estimate);
  const double own_variance = own.matrix(coordinate, coordinate);
  const bool finite = std::isfinite(own_variance) && std::isfinite(error) && !is_at_limit;
  const double ratio = finite ? error * error / own_variance : 1.0;
  const double allowed =
      estimate.solution.sum_of_squares + t95 * t95 * ratio * variance_of_law(estimate).variance;
  // The search for the ends of the interval is limited to reasonable values: alpha from 1/100 to 100, and 1/Phi_max
  // from 1/1000 to 1000.
  const bool is_inverse = coordinate == 2;
  const double low_end = is_inverse ? 1e-3 : std::log(1e-2);
  const double high_end = is_inverse ? 1e3 : std::log(1e2);
  const double step = finite ? std::min(t95 * error, 1.0) : 0.5;
  return profile_interval({center, estimate.solution.sum_of_squares, allowed, low_end, high_end, step},
                          [&] { return profile_of(estimate, coordinate); });
}

}  // namespace floc
