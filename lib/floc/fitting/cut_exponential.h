#pragma once

#include <vector>

namespace floc {

/// Values in a window of an exponential distribution, measured from where the window begins.
struct CutSample {
  double width = 0.0;  ///< of the window, > 0; infinite: a whole tail
  int n = 0;           ///< values in it
  double mean = 0.0;   ///< of them, from the beginning of the window
};

/// The values from low to high, both included. @param high  may be infinite
CutSample cut_sample(const std::vector<double>& values, double low, double high);

/// An exponent of P(x) ~ exp(-b x), over one unit of x.
struct ExponentEstimate {
  bool found = false;  ///< false with fewer than ten values, or where the likelihood has no maximum
  int n = 0;           ///< values
  double b = 0.0;      ///< for windows of finite width it may have either sign
  double error = 0.0;  ///< standard error, from Fisher's information
};

/// Maximum likelihood of one exponent shared by several windows, each cut to its width, given how many values
/// are in each: sum of n (m(b) - mean) = 0, with m(b) = 1/b - w/(exp(b w) - 1) the mean in a window of width w.
[[nodiscard]] ExponentEstimate fit_exponent(const std::vector<CutSample>& windows);

}  // namespace floc
