#include "floc/fitting/student_t.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace floc {
namespace {

/// Returns the probability that a Student variable t of `dof` degrees of freedom has |t| <= sqrt(dof)
/// tan(theta).
double probability_within(double theta, int dof) {
  const double cos2 = std::cos(theta) * std::cos(theta);
  const bool odd = dof % 2 == 1;
  double term = odd ? std::cos(theta) : 1.0;
  double sum = 0.0;
  for (int k = odd ? 1 : 0; k < dof - 1; k += 2) {
    sum += term;
    term *= cos2 * (k + 1.0) / (k + 2.0);
  }
  return odd ? 2.0 / std::numbers::pi * (theta + std::sin(theta) * sum) : std::sin(theta) * sum;
}

}  // namespace

double student_t_95(int dof) {
  assert(dof >= 1);
  double low = 0.0;
  double high = std::numbers::pi / 2;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return std::sqrt(dof) * std::tan(low);
    (probability_within(middle, dof) < 0.95 ? low : high) = middle;
  }
}

}  // namespace floc
