#pragma once

#include <optional>
#include <vector>

namespace floc {

/// Mean of a quantity over independent samples.
struct SampleMean {
  int n = 0;
  double mean = 0.0;
  std::optional<double> deviation;  ///< standard deviation (n - 1 in the denominator); absent for one sample
  double low = 0.0, high = 0.0;     ///< smallest and largest value of the samples

  /// Returns the standard error of the mean, deviation/sqrt(n); absent for one sample.
  std::optional<double> standard_error() const;
};

SampleMean mean_of_samples(const std::vector<double>& values);

/// A mean from another source, such as a publication, for comparison with a mean of a campaign.
struct ReferenceMean {
  int n = 1;
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation of the samples; for n = 1 the standard error of `mean`
};

/// Result of the comparison of a mean with a reference mean.
struct Difference {
  double value = 0.0;  ///< mean minus reference
  /// Largest difference at which the means agree, 2.6 sqrt(s^2/n + s_ref^2/n_ref), with the standard deviations s and
  /// s_ref and the numbers n and n_ref of samples. Absent for n = 1, because s is then unknown.
  std::optional<double> allowed;
  bool agrees = false;  ///< whether abs(value) <= allowed
};

/// Compares a mean with its reference. If the errors are normally distributed, two means of the same quantity differ by
/// more than 2.6 standard errors of the difference in one of a hundred comparisons.
Difference difference_of(const SampleMean& mean, const ReferenceMean& reference);

}  // namespace floc
