#include "floc/fitting/correlated_mean.h"

#include <cassert>
#include <cmath>
#include <numeric>

#include "floc/fitting/student_t.h"

namespace floc {
namespace {

constexpr std::size_t kBatches = 5;

double arithmetic_mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

FittedParameter mean_of_samples(const std::string& name, const std::vector<double>& values) {
  assert(!values.empty());
  const double center = arithmetic_mean(values), n = static_cast<double>(values.size());
  if (values.size() < 2) return held_at(name, center);
  double squares = 0.0;
  for (const double v : values) squares += (v - center) * (v - center);
  return from_value(name, center, std::sqrt(squares / (n - 1.0) / n),
                    student_t_95(static_cast<int>(values.size()) - 1));
}

FittedParameter mean_along_path(const std::string& name, const std::vector<double>& values) {
  assert(!values.empty());
  const double center = arithmetic_mean(values);
  if (values.size() < 2 * kBatches) return held_at(name, center);
  // If the number of values is not a multiple of the number of batches, some values at the beginning are in no batch.
  const std::size_t length = values.size() / kBatches, first = values.size() - kBatches * length;
  std::vector<double> batches;
  for (std::size_t b = 0; b < kBatches; ++b) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first + b * length);
    batches.push_back(arithmetic_mean({begin, begin + static_cast<std::ptrdiff_t>(length)}));
  }
  FittedParameter p = mean_of_samples(name, batches);
  return from_value(name, center, *p.standard_error, student_t_95(kBatches - 1));
}

}  // namespace floc
