#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "floc/base/random.h"
#include "floc/base/range.h"
#include "floc/fitting/fitted_parameter.h"

namespace floc {

// Distributions of contact forces f ([RTV2010], Eqs 2-5), each with one free parameter. Distributions of
// compressive networks are those of f over its mean, with norm and mean 1 by construction.

/// A distribution of f >= 0 with one free parameter.
struct ForceLaw {
  const char* name;
  const char* parameter;                              ///< name of the free parameter
  double low, high;                                   ///< range of the free parameter
  std::function<double(double, double)> log_density;  ///< (parameter, f)
  std::function<double(double, double)> cumulative;   ///< (parameter, f)
  std::function<double(double, RandomStream&)> draw;  ///< a force
};

/// P(f) = k f^-alpha below the mean, k exp[beta (1 - f)] above; beta^2 = (1-alpha)(2-alpha), 1/k = 1/(1-alpha)
/// + 1/beta. Free: alpha < 1.
const ForceLaw& power_exponential();

/// P(f) = a (1 - b exp(-f^2)) exp(-beta f); a and b follow from norm and mean. Free: beta.
const ForceLaw& quadratic_exponential();

/// A fit by maximum likelihood and its quality, or the reason why there is none.
struct ForceFit {
  std::string form;            ///< power_exponential, quadratic_exponential, tail_positive, tail_negative
  std::string failure_reason;  ///< empty when there is a fit
  std::vector<FittedParameter> parameters;  ///< the free one first
  int n = 0;                                ///< forces fitted
  double mean = 0.0;                        ///< force that f is measured in; threshold of a tail
  double log_likelihood = 0.0;              ///< log-likelihood of f (nats)
  double distance = 0.0;  ///< Kolmogorov-Smirnov: largest difference of the cumulative distributions
  double p_value = 0.0;   ///< share of samples drawn from the fit, and fitted again, whose distance is as large

  bool found() const { return failure_reason.empty(); }
};

struct ForceFitOptions {
  int n_draws = 200;  ///< samples drawn for the p-value, which is then known to 0.015 near 0.05
  std::uint64_t seed = 1;

  static constexpr WholeRange kDraws{.least = 1, .most = 100000};
};

/// Fits a law of compressive networks by maximum likelihood, with intervals by the likelihood ratio. There is
/// no fit with fewer than 10 forces. @param forces  > 0, in any unit
/// @throws InputError unless the draws are in ForceFitOptions::kDraws
[[nodiscard]] ForceFit fit_compressive_forces(const ForceLaw& law, std::vector<double> forces,
                                              const ForceFitOptions& options);

/// Fits an exponential tail, P(f) ~ exp[-(f - threshold)/f_0] beyond the threshold; the free parameter is f_0,
/// in the unit of the forces. There is no fit with fewer than 10 forces beyond the threshold.
/// @param forces  sizes, > 0   @param threshold  >= 0
/// @throws InputError for another threshold, or draws that are not in ForceFitOptions::kDraws
[[nodiscard]] ForceFit fit_exponential_tail(const std::string& form, const std::vector<double>& forces,
                                            double threshold, const ForceFitOptions& options);

}  // namespace floc
