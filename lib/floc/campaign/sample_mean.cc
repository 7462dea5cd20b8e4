#include "floc/campaign/sample_mean.h"

#include <algorithm>
#include <cmath>

namespace floc {

std::optional<double> SampleMean::standard_error() const {
  return deviation ? std::optional(*deviation / std::sqrt(n)) : std::nullopt;
}

SampleMean mean_of_samples(const std::vector<double>& values) {
  SampleMean result;
  result.n = static_cast<int>(values.size());
  if (values.empty()) return result;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  result.low = *low;
  result.high = *high;
  double sum = 0.0;
  for (const double x : values) sum += x - *low;
  // The smallest value is subtracted from all values before they are summed, so that the mean of equal values is
  // exactly this value.
  result.mean = *low + sum / result.n;
  if (result.n < 2) return result;
  double squares = 0.0;
  for (const double x : values) squares += (x - result.mean) * (x - result.mean);
  result.deviation = std::sqrt(squares / (result.n - 1));
  return result;
}

Difference difference_of(const SampleMean& mean, const ReferenceMean& reference) {
  constexpr double kStandardErrors = 2.6;
  Difference result;
  result.value = mean.mean - reference.mean;
  if (!mean.deviation) return result;
  result.allowed = kStandardErrors * std::sqrt(*mean.deviation * *mean.deviation / mean.n +
                                               reference.deviation * reference.deviation / reference.n);
  result.agrees = std::abs(result.value) <= *result.allowed;
  return result;
}

}  // namespace floc
