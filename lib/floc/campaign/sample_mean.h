#pragma once

#include <optional>
#include <vector>

namespace floc {

/// Mean of a quantity over independent samples.
struct SampleMean {
  int n = 0;
  double mean = 0.0;
  std::optional<double> deviation;  ///< standard deviation (n - 1 in the denominator); none for one sample
  double low = 0.0, high = 0.0;     ///< smallest and largest value

  /// Returns deviation/sqrt(n); none without a deviation.
  std::optional<double> standard_error() const;
};

SampleMean mean_of_samples(const std::vector<double>& values);

/// A reference mean that another mean is compared with.
struct ReferenceMean {
  int n = 1;
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation of its samples; for n = 1 the standard error
};

/// Two means side by side.
struct Difference {
  double value = 0.0;             ///< mean - reference
  std::optional<double> allowed;  ///< 2.6 sqrt(s^2/n + s_ref^2/n_ref); absent without a deviation s
  bool agrees = false;            ///< abs(value) <= allowed
};

/// Compares two means. Normal errors exceed 2.6 standard errors in one of a hundred comparisons.
Difference difference_of(const SampleMean& mean, const ReferenceMean& reference);

}  // namespace floc
