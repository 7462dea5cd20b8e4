#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "floc/base/random.h"
#include "floc/base/range.h"
#include "floc/fitting/fitted_parameter.h"

namespace floc {

// Distributions of contact forces f ([RTV2010], Eqs 2-5), each with one free parameter. Here, f is the compressive
// force divided by its mean, so that every distribution has the integral 1 and the mean 1.

/// Distribution of the contact force f >= 0 with one free parameter.
struct ForceLaw {
  const char* name;
  const char* parameter;  ///< name of the free parameter
  double low, high;       ///< range of the free parameter
  /// Ln of the probability density of the force f, as a function of (parameter, f).
  std::function<double(double, double)> log_density;
  /// Cumulative probability of the force f, as a function of (parameter, f).
  std::function<double(double, double)> cumulative;
  std::function<double(double, RandomStream&)> draw;  ///< random force from the law with the given parameter
};

/// Returns the law with the probability density P(f) = k f^-alpha for f < 1, and k exp[beta (1 - f)] for f > 1. The
/// free parameter is alpha < 1; beta and k follow from beta^2 = (1-alpha)(2-alpha) and 1/k = 1/(1-alpha) + 1/beta.
const ForceLaw& power_exponential();

/// Returns the law with the probability density P(f) = a (1 - b exp(-f^2)) exp(-beta f). The free parameter is beta.
/// The constants a and b follow from two conditions: the integral of P is 1, and the mean of f is 1.
const ForceLaw& quadratic_exponential();

/// Maximum-likelihood fit of a force distribution and the quality of this fit, or the reason why there is no fit.
struct ForceFit {
  /// Name of the law: power_exponential, quadratic_exponential, tail_positive or tail_negative.
  std::string form;
  std::string failure_reason;               ///< reason why there is no fit; empty if there is one
  std::vector<FittedParameter> parameters;  ///< parameters of the law, the fitted one first
  int n = 0;                                ///< number of forces fitted
  /// Mean of the forces; for an exponential tail, the threshold where it begins.
  double mean = 0.0;
  double log_likelihood = 0.0;  ///< log-likelihood of the forces (natural logarithm)
  /// Kolmogorov-Smirnov distance: largest difference between the cumulative distribution of the forces and that of the
  /// law.
  double distance = 0.0;
  /// Probability of a distance of at least `distance` if the forces follow the law. The probability is estimated from
  /// random samples of the fitted law; the law is fitted again to each sample.
  double p_value = 0.0;

  bool found() const { return failure_reason.empty(); }
};

struct ForceFitOptions {
  /// Number of random samples drawn for the p-value; with 200 samples, a p-value near 0.05 has a standard error of
  /// 0.015.
  int n_draws = 200;
  std::uint64_t seed = 1;

  static constexpr WholeRange kDraws{.least = 1, .most = 100000};
};

/// Fits a distribution of forces in compression by maximum likelihood, with a 95 % interval from the likelihood ratio.
/// There is no fit with fewer than 10 forces.
/// @param forces  compressive forces, > 0, in any unit
/// @throws InputError if options.n_draws is not in ForceFitOptions::kDraws
[[nodiscard]] ForceFit fit_compressive_forces(const ForceLaw& law, std::vector<double> forces,
                                              const ForceFitOptions& options);

/// Fits an exponential tail P(f) ~ exp[-(f - threshold)/f_0] to the forces beyond the threshold. The free parameter is
/// f_0, in the unit of the forces. There is no fit with fewer than 10 forces beyond the threshold.
/// @param forces  magnitudes of the forces, > 0   @param threshold  force beyond which the tail begins, >= 0
/// @throws InputError if the threshold is negative or options.n_draws is not in ForceFitOptions::kDraws
[[nodiscard]] ForceFit fit_exponential_tail(const std::string& form, const std::vector<double>& forces,
                                            double threshold, const ForceFitOptions& options);

}  // namespace floc
