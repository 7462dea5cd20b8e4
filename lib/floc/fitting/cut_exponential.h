#pragma once

#include <vector>

namespace floc {

/// Summary of the values that lie in a window [low, high] of an exponential distribution.
struct CutSample {
  double width = 0.0;  ///< width of the window, > 0; infinite if the window has no upper end
  int n = 0;           ///< number of values in the window
  double mean = 0.0;   ///< mean distance of the values in the window from its lower end
};

/// Returns the summary of the values from `low` to `high`, both included. @param high  upper end of the window; may be
/// infinite
CutSample cut_sample(const std::vector<double>& values, double low, double high);

/// Estimate of the exponent b of a probability density P(x) ~ exp(-b x), in the unit of 1/x.
struct ExponentEstimate {
  bool found = false;  ///< false if there are fewer than ten values, or if the likelihood has no maximum
  int n = 0;           ///< number of values in all windows
  double b = 0.0;      ///< exponent; negative values are possible if all windows have a finite width
  double error = 0.0;  ///< standard error, from Fisher's information
};

/// Estimates one exponent b by maximum likelihood from the values in several windows of an exponential distribution.
/// The number n of values in each window is treated as given. The exponent b is the root of the sum of n [m(b) - mean]
/// over the windows. Here, `mean` is the mean distance of the values from the lower end of their window, and m(b) = 1/b
/// - w/(exp(b w) - 1) is the expected distance in a window of width w.
[[nodiscard]] ExponentEstimate fit_exponent(const std::vector<CutSample>& windows);

}  // namespace floc
