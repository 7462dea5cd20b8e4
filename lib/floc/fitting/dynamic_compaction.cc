#include "floc/fitting/dynamic_compaction.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "floc/base/dense_solvers.h"
#include "floc/base/infinity.h"
#include "floc/base/range.h"
#include "floc/fitting/least_squares.h"
#include "floc/fitting/profile_likelihood.h"
#include "floc/fitting/robust.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

constexpr int kParameters = 7;
constexpr std::array<const char*, kParameters> kNames = {"e_min", "De", "C", "A", "s_m", "a", "b"};
using Parameters = Eigen::Matrix<double, kParameters, 1>;

/// Residual of the void ratio e of one sample. The parameter De of the plateau belongs to a reference pressure. During
/// the fit, this is not p_D but p_m, the geometric mean over the samples of the pressure at which the plateau is
/// evaluated, because the law may have a pole between p_D and the pressures of the samples.
struct CompactionResidual {
  static constexpr int kParameters = floc::kParameters;
  /// ln(p/p_m), where p is the pressure at which the plateau is evaluated for this sample.
  double log_p;
  double log_x, e, weight;
  template <class T>
  T operator()(const T* theta) const {
    return weight * (compacted_void_ratio(theta, log_p, log_x) - e);
  }
};
using Residuals = std::vector<CompactionResidual>;

/// Samples to which the law of dynamic compaction is fitted, and reference values of the law.
struct CompactionData {
  std::vector<int> rows;  ///< index of the sample of each residual
  Residuals residuals;
  /// ln(p_D/p_m), with p_m as in CompactionResidual.
  double log_p_D = 0.0;
  double log_x_1 = 0.0;  ///< ln x at eta* = 1, with x = eta*/eta_m and eta* = sc/sqrt(p se)

  CompactionData without(const std::vector<int>& left_out) const {
    CompactionData rest{{}, {}, log_p_D, log_x_1};
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (std::find(left_out.begin(), left_out.end(), rows[k]) == left_out.end())
        rest.rows.push_back(rows[k]), rest.residuals.push_back(residuals[k]);
    return rest;
  }
};

double plateau_pressure(const CompactedSample& s, PlateauPressure plateau) {
  return plateau == PlateauPressure::own ? s.p : s.sc * s.sc / s.se;
}

/// Sets the parameters De and C of the plateau in a starting point `theta`. The other entries of theta are set already:
/// e_min, and the two power laws from which e_r follows. De and C follow from a linear fit of e_r/(e - e_min) = 1/De +
/// C ln p, where p is the pressure at which the plateau is evaluated.
/// @return false if this fit gives no positive De
bool add_plateau(const Residuals& data, Eigen::VectorXd& theta) {
  const auto n = static_cast<Eigen::Index>(data.size());
  Eigen::MatrixXd columns(n, 2);
  Eigen::VectorXd y(n);
  const double a = std::exp(theta[5]);
  const double b = a + std::exp(theta[6]);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CompactionResidual& r = data[static_cast<std::size_t>(i)];
    const double S = std::exp(theta[3] + a * r.log_x) + std::exp(theta[4] + b * r.log_x);
    // Both sides of e_r/(e - e_min) = 1/De + C ln p are multiplied by (e - e_min)^2/e_r, so that the residuals are in
    // proportion to the residuals of the void ratio e.
    const double over = r.e - theta[0];
    const double e_r = S / (1.0 + S);
    columns.row(i) << over * over / e_r, over * over / e_r * r.log_p;
    y[i] = over;
  }
  // If all samples have the same pressure, there are many solutions; the solution with the smallest norm is taken.
  const Eigen::Vector2d found = least_squares_solution(columns, y);
  if (!(found[0] > 0.0) || !found.allFinite()) return false;
  theta[1] = -std::log(found[0]);
  theta[2] = found[1];
  return true;
}

/// Returns starting points of the fit that cover the ranges of e_min, of the exponents a and b, and of the prefactors
/// of the two power laws. The parameters published in [SVI2024] are among them.
std::vector<Eigen::VectorXd> starts_of(const Residuals& data) {
  const auto less = [](const auto& r, const auto& s) { return r.e < s.e; };
  const auto [low, high] = std::minmax_element(data.begin(), data.end(), less);
  std::vector<Eigen::VectorXd> starts;
  for (const double below : {0.01, 0.1, 0.4})
    for (const double a : {0.4, 0.74, 1.2})
      for (const double step : {0.6, 1.56})
        for (const double scale : {0.2, 1.0, 5.0}) {
          Eigen::VectorXd theta(kParameters);
          theta << low->e - below * (high->e - low->e), 0.0, 0.0, std::log(0.475 * scale),
              std::log(0.17 * scale), std::log(a), std::log(step);
          if (add_plateau(data, theta)) starts.push_back(theta);
        }
  return starts;
}

/// Fits the law of dynamic compaction. A fast solver descends from every starting point. An exact solver continues from
/// the best end point from which it converges.
std::optional<LeastSquaresSolution> solve(const Residuals& data) {
  struct End {
    double left;
    Eigen::VectorXd theta;
  };
  std::vector<End> ends;
  for (Eigen::VectorXd theta : starts_of(data)) {
    const double left = descend(data, theta);
    if (std::isfinite(left) && theta.allFinite()) ends.push_back({left, theta});
  }
  std::ranges::stable_sort(ends, {}, &End::left);
  for (const End& end : ends)
    if (auto solution = minimize(data, end.theta)) return solution;
  return std::nullopt;
}

/// Misfit of each sample in a robust fit, used to flag samples that do not lie on the plateau.
struct RobustView {
  Eigen::VectorXd misfit;  ///< void ratio e minus its value by the law
  double deviation = 0.0;  ///< standard deviation of the misfit of a sample that follows the law
  /// Whether each sample may be flagged: it lies above the plateau of the law, or has eta* = sc/sqrt(p se) > 1.
  std::vector<bool> may_flag;
};

/// Fits the law with weights that give almost no influence to samples far from the law. The weights are recomputed from
/// the residuals until the solution no longer changes. Returns the misfit of each sample.
std::optional<RobustView> robust_view(const CompactionData& data) {
  auto solution = solve(data.residuals);
  if (!solution) return std::nullopt;
  Residuals weighted = data.residuals;
  Eigen::VectorXd misfit = -solution->residuals;
  constexpr int kRounds = 100;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd weights = loss_weights(Loss::cauchy, misfit);
    for (std::size_t k = 0; k < weighted.size(); ++k)
      weighted[k].weight = weights[static_cast<Eigen::Index>(k)];
    const Eigen::VectorXd before = solution->theta;
    auto next = minimize(weighted, before);
    if (!next) break;
    solution = std::move(next);
    misfit = -solution->residuals.cwiseQuotient(weights);
    if ((solution->theta - before).norm() <= 1e-6 * before.norm()) break;
  }
  RobustView view{misfit, 0.0, {}};
  std::vector<double> sizes(misfit.begin(), misfit.end());
  for (double& size : sizes) size = std::abs(size);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  // standard deviation divided by median absolute value, for a normal variable
  constexpr double kNormal = 1.4826;
  // The standard deviation is at least 1e-10, the rounding of a table with ten digits.
  view.deviation = std::max(kNormal * *middle, 1e-10);
  const Eigen::VectorXd& t = solution->theta;
  for (const CompactionResidual& r : data.residuals) {
    const double e_max = t[0] + 1.0 / (std::exp(-t[1]) + t[2] * r.log_p);
    view.may_flag.push_back(r.log_x > data.log_x_1 || r.e > e_max);
  }
  return view;
}

/// Returns the indices of the samples that do not lie on the plateau. A sample is among them if view.may_flag is true
/// and its distance from the law is more than `n_deviations` standard deviations.
std::vector<int> beside_plateau(const CompactionData& data, const RobustView& view, double n_deviations) {
  std::vector<int> rows;
  for (std::size_t k = 0; k < data.rows.size(); ++k)
    if (view.may_flag[k] && std::abs(view.misfit[static_cast<Eigen::Index>(k)]) > n_deviations * view.deviation)
      rows.push_back(data.rows[k]);
  return rows;
}

/// Converts the fitted numbers theta to the coordinates in which standard errors are computed: e_min, 1/De, C, and the
/// logarithms of A, s_m, a and b.
Parameters coordinates(const Eigen::VectorXd& t, double log_p_D) {
  Parameters y;
  y << t[0], std::exp(-t[1]) + t[2] * log_p_D, t[2], t[3], -std::log(std::exp(t[3]) + std::exp(t[4])), t[5],
      std::log(std::exp(t[5]) + std::exp(t[6]));
  return y;
}

/// Returns the derivatives of coordinates() with respect to the fitted numbers theta.
Eigen::MatrixXd gradients(const Eigen::VectorXd& t, double log_p_D) {
  const double A = std::exp(t[3]), rest = std::exp(t[4]), a = std::exp(t[5]), b = a + std::exp(t[6]);
  Eigen::MatrixXd G = Eigen::MatrixXd::Identity(kParameters, kParameters);
  G.row(1) << 0, -std::exp(-t[1]), log_p_D, 0, 0, 0, 0;
  G.row(4) << 0, 0, 0, -A / (A + rest), -rest / (A + rest), 0, 0;
  G.row(6) << 0, 0, 0, 0, 0, a / b, 1.0 - a / b;
  return G;
}

/// Returns the standard errors of coordinates(). Entries of theta on which a coordinate does not depend are left out of
/// its variance, because their own variance may be infinite.
/// @param G  gradients() of the coordinates
/// @param covariance  covariance of theta
Parameters errors_of(const Eigen::MatrixXd& G, const Eigen::MatrixXd& covariance) {
  Parameters errors;
  for (int k = 0; k < kParameters; ++k) {
    double sum = 0.0;
    for (int i = 0; i < kParameters; ++i)
      for (int j = 0; j < kParameters; ++j)
        if (G(k, i) != 0.0 && G(k, j) != 0.0) sum += G(k, i) * covariance(i, j) * G(k, j);
    errors[k] = std::sqrt(std::max(sum, 0.0));
  }
  return errors;
}

/// Returns the variance of the void ratio e between runs with equal p, sc and se; absent if no run is repeated.
std::optional<double> variance_between_runs(const std::vector<CompactedSample>& samples,
                                            const std::vector<int>& rows) {
  std::map<std::tuple<double, double, double>, std::vector<double>> runs;
  for (const int i : rows) {
    const CompactedSample& s = samples[static_cast<std::size_t>(i)];
    runs[{s.p, s.sc, s.se}].push_back(s.e);
  }
  double sum = 0.0;
  int dof = 0;
  for (const auto& [point, e] : runs) {
    const Eigen::Map<const Eigen::ArrayXd> v(e.data(), static_cast<Eigen::Index>(e.size()));
    sum += (v - v.mean()).square().sum();
    dof += static_cast<int>(e.size()) - 1;
  }
  return dof > 0 ? std::optional(sum / dof) : std::nullopt;
}

/// Fit of the law of dynamic compaction, with the values of coordinates() and their errors.
struct CompactionEstimate {
  CompactionData data;
  LeastSquaresSolution solution;
  double variance = 0.0;       ///< variance of the residuals
  double scatter_share = 1.0;  ///< fraction of `variance` that is the scatter between repeated runs
  Eigen::MatrixXd covariance;  ///< covariance of theta, from the residuals
  /// Values of coordinates(), and two parts of their standard errors: `scatter` from the residuals, and `spread` from
  /// the choice of the samples that are left out.
  Parameters value, scatter, spread;

  int dof() const { return static_cast<int>(data.rows.size()) - kParameters; }
  double error(int k) const { return std::hypot(scatter[k], spread[k]); }
};

/// Returns the root mean square change of each of coordinates() if the threshold is smaller or larger. The threshold is
/// the distance from the law beyond which a sample is flagged as not lying on the plateau.
Parameters spread_over_flags(const CompactionEstimate& estimate, const CompactionData& all,
                             const RobustView& view, const std::vector<int>& flagged) {
  Parameters sum = Parameters::Zero();
  constexpr std::array<double, 2> kOtherLimits = {2.5, 6.0};
  for (const double limit : kOtherLimits) {
    const std::vector<int> others = beside_plateau(all, view, limit);
    const CompactionData rest = all.without(others);
    if (others == flagged || rest.rows.size() <= kParameters) continue;
    if (const auto solution = minimize(rest.residuals, estimate.solution.theta))
      sum += (coordinates(solution->theta, all.log_p_D) - estimate.value).cwiseAbs2() / kOtherLimits.size();
  }
  return sum.cwiseSqrt();
}

CompactionEstimate estimate_of(CompactionData data, LeastSquaresSolution solution) {
  CompactionEstimate e{std::move(data), std::move(solution), 0.0, 1.0, {}, {}, {}, Parameters::Zero()};
  e.variance = e.solution.sum_of_squares / e.dof();
  e.covariance = e.variance * unit_covariance(e.solution.jacobian);
  e.value = coordinates(e.solution.theta, e.data.log_p_D);
  e.scatter = errors_of(gradients(e.solution.theta, e.data.log_p_D), e.covariance);
  return e;
}

FittedParameter parameter_of(const CompactionEstimate& e, int k) {
  const double t95 = student_t_95(e.dof());
  const std::string name = kNames[static_cast<std::size_t>(k)];
  if (k == 0 || k == 2) return from_value(name, e.value[k], e.error(k), t95);
  if (k == 1 && e.value[k] > 0.0) return from_inverse(name, e.value[k], e.error(k), t95);
  if (k == 1) return {name, std::nullopt, std::nullopt, std::nullopt, std::nullopt, false};
  return from_logarithm(name, e.value[k], e.error(k), t95);
}

/// Replaces the 95 % interval of the parameter A (or a) by the interval from the profile likelihood of ln A (or ln a).
void profile(const CompactionEstimate& e, int k, FittedParameter& p, CompactionFit& fit) {
  const double error = e.error(k);
  // If the standard error is very small, changes of the sum of squares are only rounding, and the interval from the
  // covariance is kept.
  if (!std::isfinite(error) || error < 1e-9) return;
  const double t95 = student_t_95(e.dof());
  const double inflated = std::pow(t95 * error / e.scatter[k], 2) * e.variance;
  // The ends of the interval are searched up to a factor of 100 from the solution; the law has no meaning beyond this
  // factor.
  const double reach = std::log(100.0);
  const double center = e.value[k];
  const ProfileSearch search{
      center,         e.solution.sum_of_squares, e.solution.sum_of_squares + inflated, center - reach,
      center + reach, std::min(t95 * error, 1.0)};
  const ProfileInterval found = profile_interval(search, [&]() -> ProfileFunction {
    return [&e, k, theta = e.solution.theta](double value) mutable {
      Eigen::VectorXd start = theta;
      start[k] = value;
      const auto solution = minimize(e.data.residuals, start, {}, k);
      if (!solution) return kInfinity;
      theta = solution->theta;
      return solution->sum_of_squares;
    };
  });
  p.low95 = p.high95 = std::nullopt;
  fit.profiled.push_back(p.name);
  // An interval is accepted only if its width, divided by the width from the covariance, is at least this value. If
  // many solutions are nearly equal, the solver stops early, which makes the interval too narrow.
  constexpr double kFollowed = 0.1;
  const double width = 2.0 * t95 * error;
  p.identified = false;
  if (found.low && found.high && *found.high - *found.low < kFollowed * width) return;
  if (found.low) p.low95 = std::exp(*found.low);
  if (found.high) p.high95 = std::exp(*found.high);
  constexpr double kIdentifiedFactor = 10.0;
  p.identified = p.low95 && p.high95 && *p.value < kIdentifiedFactor * *p.low95 &&
                 *p.high95 < kIdentifiedFactor * *p.value;
}

/// Returns the parts of the standard error of a parameter: the parts of the error of coordinate `k` in coordinates(),
/// times a common factor. With this factor, the squares of the parts add up to the squared error of the parameter.
CompactionErrorParts parts_of(const CompactionEstimate& e, int k, const FittedParameter& p) {
  const double all = e.error(k);
  const double unit = all > 0.0 ? *p.standard_error / all : 0.0;
  return {p.name, unit * e.scatter[k] * std::sqrt(e.scatter_share),
          unit * e.scatter[k] * std::sqrt(1.0 - e.scatter_share), unit * e.spread[k]};
}

/// Returns the number of samples that determine the first power law A x^a of the law: dense samples (e_r < 1/2) for
/// which A x^a is larger than the second power law (1/s_m - A) x^b.
int n_of_first_power(const CompactionEstimate& e) {
  const Eigen::VectorXd& t = e.solution.theta;
  const double a = std::exp(t[5]), step = std::exp(t[6]);
  return static_cast<int>(std::count_if(e.data.residuals.begin(), e.data.residuals.end(), [&](const auto& r) {
    const double first = std::exp(t[3] + a * r.log_x), second = std::exp(t[4] + (a + step) * r.log_x);
    return first > second && first + second < 1.0;
  }));
}

void add_parameters(const CompactionEstimate& e, CompactionFit& fit) {
  // Two samples determine the prefactor and the exponent of the first power law. A third sample is needed to
  // distinguish the first power law from the second.
  const bool sees_first_power = n_of_first_power(e) >= 3;
  for (int k = 0; k < kParameters; ++k) {
    FittedParameter p = parameter_of(e, k);
    const bool of_first_power = p.name == "A" || p.name == "a";
    if (of_first_power) {
      profile(e, k, p, fit);
      p.identified = p.identified && sees_first_power;
    }
    if (const std::string beyond = keep_in_range({0.0, std::numeric_limits<double>::infinity()}, p);
        !beyond.empty()) {
      fit.warnings.push_back(beyond);
    } else if (p.identified) {
      fit.error_parts.push_back(parts_of(e, k, p));
    } else {
      const char* why = k == 1 && !(e.value[k] > 0.0)
                            ? ": the law of the plateau has a pole between the pressures of the samples and p_D"
                        : of_first_power && !sees_first_power
                            ? ": fewer than three samples are so dense (e_r < 1/2) that the power law with the "
                              "smaller exponent dominates"
                            : "";
      fit.warnings.push_back(fmt::format("{} is not identified by these data{}", p.name, why));
      p.value = p.standard_error = std::nullopt;
    }
    fit.parameters.push_back(std::move(p));
  }
  const Eigen::MatrixXd G = gradients(e.solution.theta, e.data.log_p_D);
  Eigen::MatrixXd c = G * e.covariance * G.transpose();
  // Row and column 1 are correlations of 1/De. The correlations of De have the opposite sign, because 1/De falls as De
  // grows.
  c.row(1) *= -1.0, c.col(1) *= -1.0;
  const Eigen::VectorXd scale = c.diagonal().cwiseSqrt().cwiseInverse();
  fit.correlation = scale.asDiagonal() * c * scale.asDiagonal();
}

/// Returns the samples to fit: samples whose plateau is evaluated at a pressure of at least p_0. Adds the indices of
/// all other samples to fit.below_p_0.
CompactionData data_of(const std::vector<CompactedSample>& samples, const CompactionReference& reference,
                       double p_0, CompactionFit& fit) {
  CompactionData data;
  data.log_x_1 = -std::log(reference.eta_m);
  double middle = 0.0;
  for (int i = 0; i < static_cast<int>(samples.size()); ++i) {
    const CompactedSample& s = samples[static_cast<std::size_t>(i)];
    const double p = plateau_pressure(s, reference.plateau);
    // With the tolerance, a sample whose pressure equals p_0 up to rounding is fitted.
    if (p < p_0 * (1 - 1e-6)) {
      fit.below_p_0.push_back(i);
      continue;
    }
    middle += std::log(p);
    data.rows.push_back(i);
    data.residuals.push_back({std::log(p), std::log(s.sc / std::sqrt(s.p * s.se) / reference.eta_m), s.e, 1.0});
  }
  if (!data.rows.empty()) middle /= static_cast<double>(data.rows.size());
  for (CompactionResidual& r : data.residuals) r.log_p -= middle;
  data.log_p_D = std::log(reference.p_D) - middle;
  return data;
}

/// Warns about the samples left out of the fit. Compares the residuals with the scatter between repeated runs.
void describe(const std::vector<CompactedSample>& samples, CompactionEstimate& estimate, CompactionFit& fit) {
  if (!fit.beside_plateau.empty())
    fit.warnings.push_back(fmt::format(
        "{} of the {} samples lie above the plateau of the law or at eta* > 1, and miss the law by more than "
        "four standard deviations: they are flagged as samples that do not lie on the plateau, and not fitted",
        fit.beside_plateau.size(), samples.size()));
  fit.rms = std::sqrt(estimate.solution.sum_of_squares / static_cast<double>(fit.used.size()));
  const auto between_runs = variance_between_runs(samples, fit.used);
  fit.errors_from_runs = between_runs.has_value();
  if (!between_runs || !(estimate.variance > 0.0)) return;
  estimate.scatter_share = std::min(*between_runs / estimate.variance, 1.0);
  if (estimate.scatter_share < 0.25)
    fit.warnings.push_back(
        fmt::format("the law misses the void ratio e by {:.3g} (root mean square), but repeated runs scatter "
                    "only by {:.3g}: the main part of the standard errors is the misfit of the law",
                    std::sqrt(estimate.variance), std::sqrt(*between_runs)));
}

}  // namespace

std::vector<std::string> CompactionReference::validate() const {
  std::vector<std::string> faults = {range_fault("p_D", p_D, kPositiveNumber),
                                     range_fault("eta_m", eta_m, kPositiveNumber),
                                     range_fault("p_0", p_0, kNotNegativeNumber)};
  std::erase(faults, "");
  return faults;
}

CompactionFit fit_dynamic_compaction(const std::vector<CompactedSample>& samples,
                                     const CompactionReference& reference) {
  refuse_faults(reference.validate());
  CompactionFit fit;
  const bool at_own = reference.plateau == PlateauPressure::own;
  const char* name = at_own ? "p" : "p_crit = sc^2/se";
  const double p_0 = reference.p_0 > 0.0 || at_own ? reference.p_0 : reference.p_D;
  const CompactionData data = data_of(samples, reference, p_0, fit);
  if (!fit.below_p_0.empty())
    fit.warnings.push_back(fmt::format("{} of the {} samples have {} below {:.4g} and are left out",
                                       fit.below_p_0.size(), samples.size(), name, p_0));
  const auto too_few = [&](const char* which) {
    return fmt::format("there are {} samples{}, but a fit of the law needs {}", fit.used.size(), which,
                       kParameters + 1);
  };
  fit.used = data.rows;
  if (fit.used.size() <= kParameters) {
    fit.failure_reason = too_few(p_0 > 0.0 ? fmt::format(" with {} >= {:.4g}", name, p_0).c_str() : "");
    return fit;
  }
  const auto view = robust_view(data);
  if (view) fit.beside_plateau = beside_plateau(data, *view, 4.0);
  const CompactionData kept = data.without(fit.beside_plateau);
  fit.used = kept.rows;
  if (fit.used.size() <= kParameters) {
    fit.failure_reason = too_few(" on the plateau or below it");
    return fit;
  }
  const auto solution = solve(kept.residuals);
  if (!view || !solution) {
    fit.failure_reason =
        "the fit finds no solution from any starting point: the void ratio does not follow the law";
    return fit;
  }
  CompactionEstimate estimate = estimate_of(kept, *solution);
  estimate.spread = spread_over_flags(estimate, data, *view, fit.beside_plateau);
  describe(samples, estimate, fit);
  add_parameters(estimate, fit);
  return fit;
}

}  // namespace floc
