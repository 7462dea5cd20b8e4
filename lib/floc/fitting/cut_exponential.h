#pragma once

#include <vector>

namespace floc {

/// Values in a window of an exponential distribution, measured from the beginning of the window.
struct CutSample {
  double width = 0.0;  ///< width of the window, > 0; infinite for a whole tail
  int n = 0;           ///< number of values in it
  double mean = 0.0;   ///< mean of these values, from the beginning of the window
};

/// Returns the values from low to high, both included. @param high  may be infinite
CutSample cut_sample(const std::vector<double>& values, double low, double high);

/// An exponent of P(x) ~ exp(-b x), over one unit of x.
struct ExponentEstimate {
  bool found = false;  ///< false with fewer than ten values, or where the likelihood has no maximum
  int n = 0;           ///< values
  double b = 0.0;      ///< for windows of finite width it may have either sign
  double error = 0.0;  ///< standard error, from Fisher's information
};

/// Estimates one exponent shared by several windows by maximum likelihood, given the number of values in each
/// window: sum of n (m(b) - mean) = 0, with m(b) = 1/b - w/(exp(b w) - 1) the mean in a window of width w.
[[nodiscard]] ExponentEstimate fit_exponent(const std::vector<CutSample>& windows);

}  // namespace floc
