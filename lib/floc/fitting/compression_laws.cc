#include "floc/fitting/compression_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

#include "floc/base/infinity.h"
#include "floc/fitting/compression_models.h"
#include "floc/fitting/compression_starts.h"
#include "floc/fitting/least_squares.h"
#include "floc/fitting/regimes.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

constexpr NamedCompressionLaw kLaws[] = {
    {CompressionLaw::heckel, "heckel"},
    {CompressionLaw::kawakita, "kawakita"},
    {CompressionLaw::cooper_eaton, "cooper-eaton"},
    {CompressionLaw::walker, "walker"},
    {CompressionLaw::gurnham, "gurnham"},
    {CompressionLaw::adams, "adams"},
};

template <class Model>
struct DensityResidual {
  static constexpr int kParameters = Model::kParameters;
  double P, D, weight;
  template <class T>
  T operator()(const T* theta) const {
    return weight * (Model::density(theta, P) - D);
  }
};

/// A model fitted to points. The Jacobian has a column of zeros for a coordinate that was held at a given value.
struct Solution {
  Eigen::VectorXd theta, residuals;
  Eigen::MatrixXd jacobian;
  double sum_of_squares = 0.0;
  int held = -1;  ///< index of the held coordinate, -1 without one
  bool at_limit = false;

  int n_free() const { return static_cast<int>(theta.size()) - (held >= 0); }
};

template <class Model>
std::vector<DensityResidual<Model>> residuals_of(const CompressionPoints& points) {
  std::vector<DensityResidual<Model>> residuals;
  for (Eigen::Index i = 0; i < points.P.size(); ++i)
    residuals.push_back({points.P[i], points.D[i], points.weight[i]});
  return residuals;
}

/// Returns the index of the coordinate for the limit of the solid fraction in a model; -1 without such a limit.
template <class Model>
constexpr int limit_coordinate() {
  if constexpr (requires { Model::kLimit; }) return Model::kLimit;
  return -1;
}

template <class Model>
std::optional<Solution> solve(const CompressionPoints& points, const CompressionOptions& options) {
  const auto residuals = residuals_of<Model>(points);
  const int held = Model::kHasD0 && options.D0 > 0.0 ? 0 : -1;
  constexpr int kLimit = limit_coordinate<Model>();
  std::vector<ParameterLimits> limits;
  if (kLimit >= 0 && std::isfinite(options.phi_limit))
    limits.push_back({kLimit, -kInfinity, std::log(options.phi_limit)});
  std::optional<LeastSquaresSolution> best;
  // The sum of squares may have several local minima, and the solver finds only one of them from each start. The fit is
  // the smallest of these minima.
  for (Eigen::VectorXd start : starts_of<Model>(points, options.D0)) {
    for (const ParameterLimits& limit : limits)
      start[limit.parameter] = std::min(start[limit.parameter], limit.high);
    const auto found = minimize(residuals, start, limits, held);
    if (found && std::isfinite(found->sum_of_squares) &&
        (!best || found->sum_of_squares < best->sum_of_squares))
      best = found;
  }
  if (!best) return std::nullopt;
  Solution solution{best->theta, best->residuals, {}, best->sum_of_squares, held};
  // minimize() returns no Jacobian if a parameter is held, so the Jacobian is computed here in all cases.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows(points.P.size(),
                                                                              Model::kParameters);
  Eigen::VectorXd values(points.P.size());
  DifferentiatedResiduals(residuals).evaluate(solution.theta.data(), values.data(), rows.data());
  solution.jacobian = rows;
  if (held >= 0) solution.jacobian.col(held).setZero();
  // The derivatives with respect to a coordinate at its bound are kept: the true limit of the solid fraction may be
  // smaller, and the errors of the other parameters include this.
  constexpr double kAtBound = 1e-9;
  solution.at_limit = !limits.empty() && solution.theta[kLimit] > limits.front().high - kAtBound;
  return solution;
}

/// Returns the covariance of theta; the entries of a held coordinate are zero, and a coordinate that the data do not
/// determine has infinite variance. The error of each point is estimated as the residual of the point divided by 1 - h,
/// where h is the leverage of the point (estimator HC3 [MW1985]). Errors from the weights would be wrong, because the
/// dependence of the errors of D on D is unknown.
Eigen::MatrixXd covariance_of(const Solution& solution) {
  const Eigen::MatrixXd& J = solution.jacobian;
  Eigen::MatrixXd c = unit_covariance(J);
  std::vector<Eigen::Index> unknown;
  for (Eigen::Index k = 0; k < c.rows(); ++k) {
    if (std::isfinite(c(k, k))) continue;
    if (k != solution.held) unknown.push_back(k);
    c.row(k).setZero();
    c.col(k).setZero();
  }
  const Eigen::ArrayXd leverage = (J * c).cwiseProduct(J).rowwise().sum();
  constexpr double kMost = 0.99;
  const Eigen::VectorXd error = solution.residuals.array() / (1.0 - leverage.min(kMost));
  const Eigen::MatrixXd change = c * J.transpose() * error.asDiagonal();
  Eigen::MatrixXd covariance = change * change.transpose();
  for (const Eigen::Index k : unknown) covariance(k, k) = kInfinity;
  return covariance;
}

/// Returns the standard error of a quantity with the given gradient. Coordinates on which the quantity does not depend
/// are left out of the sum, because their variance may be infinite.
template <class Gradient>
double error_of(const Gradient& gradient, const Eigen::MatrixXd& covariance) {
  double variance = 0.0;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i)
    for (Eigen::Index j = 0; j < covariance.cols(); ++j)
      if (gradient[i] != 0.0 && gradient[j] != 0.0) variance += gradient[i] * covariance(i, j) * gradient[j];
  return std::sqrt(std::max(variance, 0.0));
}

/// If the data do not identify a parameter, removes its value, and each end of its interval that is far from the value.
void remove_if_unknown(FittedParameter& p) {
  constexpr double kFar = 1e3;  // largest factor between the value and an end of the interval that is kept
  if (p.identified) return;
  if (p.low95 && !(*p.low95 * kFar > *p.value)) p.low95 = std::nullopt;
  if (p.high95 && !(*p.high95 < *p.value * kFar)) p.high95 = std::nullopt;
  p.value = p.standard_error = std::nullopt;
}

template <class Model>
std::vector<FittedParameter> parameters_of(const Solution& solution, double factor, int dof) {
  using Jet = ceres::Jet<double, Model::kParameters>;
  Jet at[Model::kParameters], q[Model::kQuantities];
  for (int k = 0; k < Model::kParameters; ++k) at[k] = Jet(solution.theta[k], k);
  Model::quantities(static_cast<const Jet*>(at), q);
  const Eigen::MatrixXd covariance = factor * covariance_of(solution);
  const double t95 = student_t_95(dof);
  std::vector<FittedParameter> parameters;
  for (int k = 0; k < Model::kQuantities; ++k) {
    const double error = error_of(q[k].v, covariance);
    parameters.push_back(Model::kLogarithm[k] ? from_logarithm(Model::kNames[k], q[k].a, error, t95)
                                              : from_value(Model::kNames[k], q[k].a, error, t95));
  }
  for (FittedParameter& p : parameters) remove_if_unknown(p);
  return parameters;
}

/// Sets the parameters that were not fitted freely: D0 if the user gave it, and Phi_max if it is at its bound. In the
/// second case, Phi_max gets no value, and the upper end of its interval is the bound.
void mark_given(const CompressionOptions& options, const Solution& solution, CompressionFit& fit) {
  for (FittedParameter& p : fit.parameters) {
    if (p.name == "D0" && options.D0 > 0.0) p = held_at("D0", options.D0);
    if (p.name != "Phi_max" || !solution.at_limit) continue;
    p = {"Phi_max", {}, {}, p.low95, options.phi_limit, false};
    fit.warnings.push_back(fmt::format(
        "Phi_max is at its bound, {:g}: the best fit without this bound has a larger Phi_max, so that the law "
        "may not describe the data",
        options.phi_limit));
  }
}

ResidualPattern pattern_of(const Solution& solution) {
  return residual_pattern(solution.residuals, basis_of(solution.jacobian));
}

double aicc_of(const Solution& solution, Eigen::Index n_points) {
  const auto n = static_cast<double>(n_points);
  const double k = solution.n_free() + 1.0;  // the variance of the residuals counts as one more parameter
  const double mean = std::max(solution.sum_of_squares / n, kRoundingOfTables * kRoundingOfTables);
  return n * std::log(mean) + 2.0 * k + 2.0 * k * (k + 1.0) / (n - k - 1.0);
}

CompressionFit refused(CompressionLaw law, std::string why) {
  CompressionFit fit{};
  fit.law = law;
  fit.failure_reason = std::move(why);
  return fit;
}

/// Returns the reason why the given D0, or the given bound of the solid fraction, contradicts all points; empty if
/// neither does.
template <class Model>
std::string contradiction(const CompressionPoints& points, const CompressionOptions& options) {
  const double least = points.D.minCoeff(), most = points.D.maxCoeff();
  if (Model::kHasD0 && options.D0 >= most)
    return fmt::format("the given D0, {:g}, is not below the largest solid fraction, {:g}", options.D0, most);
  if (limit_coordinate<Model>() >= 0 && options.phi_limit <= least)
    return fmt::format("the bound of Phi_max, {:g}, is not above the smallest solid fraction, {:g}",
                       options.phi_limit, least);
  return "";
}

/// Warns if the given D0, or the given bound of the solid fraction, contradicts some points.
template <class Model>
void warn_of_contradiction(const CompressionPoints& points, const CompressionOptions& options,
                           CompressionFit& fit) {
  if (Model::kHasD0 && options.D0 > points.D.minCoeff())
    fit.warnings.push_back(fmt::format("the given D0, {:g}, is above the smallest solid fraction, {:g}",
                                       options.D0, points.D.minCoeff()));
  if (limit_coordinate<Model>() >= 0 && options.phi_limit < points.D.maxCoeff())
    fit.warnings.push_back(fmt::format("the bound of Phi_max, {:g}, is below the largest solid fraction, {:g}",
                                       options.phi_limit, points.D.maxCoeff()));
}

template <class Model>
CompressionFit fit_model(CompressionLaw law, const CompressionPoints& all, const CompressionOptions& options) {
  // The corrected Akaike criterion of n points and k parameters has the denominator n - k - 1, where k includes the
  // variance. With kParameters + 3 points, this denominator is at least 1.
  const auto least = Model::kParameters + 3;
  if (all.P.size() < least)
    return refused(law, fmt::format("there are {} pressures, but this law needs {}", all.P.size(), least));
  if (std::string why = contradiction<Model>(all, options); !why.empty()) return refused(law, std::move(why));
  const auto whole = solve<Model>(all, options);
  if (!whole) return refused(law, "no parameters of this law describe the data");
  CompressionFit fit{};
  fit.law = law;
  // Akaike criteria can be compared only between fits to equal points. The criterion therefore belongs to the fit to
  // all points, even if the parameters are those of the straight part.
  fit.aicc = aicc_of(*whole, all.P.size());
  const auto [first, n] =
      law == CompressionLaw::heckel ? straight_part(all) : std::pair{0, static_cast<int>(all.P.size())};
  const CompressionPoints part = all.range(first, n);
  const std::optional<Solution> solution = n == all.P.size() ? whole : solve<Model>(part, options);
  if (!solution) return refused(law, "no parameters of this law describe the straight part of the data");
  fit.first = first;
  fit.n_points = n;
  const int dof = n - solution->n_free();
  fit.rms = std::sqrt(solution->residuals.cwiseQuotient(part.weight).squaredNorm() / n);
  // The pattern of all residuals shows whether the law describes the whole curve. The variance factor, in contrast,
  // widens the intervals of the parameters, so that the factor is computed from the points that determine the
  // parameters.
  fit.pattern = pattern_of(*whole);
  fit.parameters = parameters_of<Model>(*solution, pattern_of(*solution).variance_factor(), dof);
  mark_given(options, *solution, fit);
  warn_of_contradiction<Model>(all, options, fit);
  if (fit.pattern.is_systematic())
    fit.warnings.push_back(fmt::format(
        "the residuals of all points are systematic (correlation {:.2f}, probability for independent errors "
        "{:.1g}): "
        "the data do not follow this law{}",
        fit.pattern.correlation, std::min(fit.pattern.smoothness_p, fit.pattern.runs_p),
        n < all.P.size()
            ? fmt::format("; only the straight part of the curve, from P = {:.4g} to {:.4g}, was fitted",
                          part.P[0], part.P[n - 1])
            : ""));
  return fit;
}

CompressionFit fit_law(CompressionLaw law, const CompressionPoints& points, const CompressionOptions& options) {
  switch (law) {
    case CompressionLaw::heckel:
      return fit_model<HeckelModel>(law, points, options);
    case CompressionLaw::kawakita:
      return fit_model<KawakitaModel>(law, points, options);
    case CompressionLaw::cooper_eaton:
      return fit_model<CooperEatonModel>(law, points, options);
    case CompressionLaw::walker:
      return fit_model<WalkerModel>(law, points, options);
    case CompressionLaw::gurnham:
      return fit_model<GurnhamModel>(law, points, options);
    case CompressionLaw::adams:
      return fit_model<AdamsModel>(law, points, options);
  }
  return refused(law, "unknown law");
}

/// Sets `delta_aicc` and the Akaike weight of each law. The laws were fitted to the same points.
void rank(std::vector<CompressionFit>& fits) {
  double least = kInfinity, sum = 0.0;
  for (const CompressionFit& fit : fits)
    if (fit.found()) least = std::min(least, fit.aicc);
  for (CompressionFit& fit : fits) {
    if (!fit.found()) continue;
    fit.delta_aicc = fit.aicc - least;
    fit.weight = std::exp(-0.5 * fit.delta_aicc);
    sum += fit.weight;
  }
  for (CompressionFit& fit : fits)
    if (fit.found()) fit.weight /= sum;
}

}  // namespace

std::span<const NamedCompressionLaw> compression_laws() {
  return kLaws;
}

std::vector<CompressionFit> fit_compression(const std::vector<double>& P, const std::vector<double>& D,
                                            std::span<const CompressionLaw> laws,
                                            const CompressionOptions& options) {
  assert(P.size() == D.size());
  const auto n = static_cast<Eigen::Index>(P.size());
  CompressionPoints points{
      Eigen::Map<const Eigen::VectorXd>(P.data(), n), Eigen::Map<const Eigen::VectorXd>(D.data(), n), {}};
  points.weight = points.D.cwiseSqrt().cwiseInverse();
  points.weight /= std::sqrt(points.weight.squaredNorm() / static_cast<double>(n));
  std::vector<CompressionFit> fits;
  for (const CompressionLaw law : laws) fits.push_back(fit_law(law, points, options));
  rank(fits);
  return fits;
}

}  // namespace floc
