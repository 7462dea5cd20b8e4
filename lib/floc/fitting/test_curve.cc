#include "floc/fitting/test_curve.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace floc {

std::string why_no_strength(const TestCurve& curve) {
  constexpr std::size_t kLeast = 4;
  if (curve.size() >= kLeast && curve.strain.back() > 0.0) return "";
  return fmt::format("it has {} states: expected at least {}, with a growing strain", curve.size(), kLeast);
}

std::size_t peak_of(const TestCurve& curve) {
  return static_cast<std::size_t>(std::max_element(curve.mobilised.begin(), curve.mobilised.end()) -
                                  curve.mobilised.begin());
}

LinearFit volume_at_peak(const TestCurve& curve, std::size_t peak) {
  constexpr double kNear = 0.95;
  std::size_t first = peak, last = peak;
  const double enough = kNear * curve.mobilised[peak];
  while (first > 0 && curve.mobilised[first - 1] >= enough) --first;
  while (last + 1 < curve.size() && curve.mobilised[last + 1] >= enough) ++last;
  // The error of the slope needs several points.
  constexpr std::size_t kLeast = 5;
  while (last - first + 1 < std::min(kLeast, curve.size())) {
    if (first > 0) --first;
    if (last + 1 < curve.size()) ++last;
  }
  const auto n = static_cast<Eigen::Index>(last - first + 1);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(n, 2);
  Eigen::VectorXd volumetric(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    columns(i, 1) = curve.strain[first + static_cast<std::size_t>(i)];
    volumetric[i] = curve.volumetric[first + static_cast<std::size_t>(i)];
  }
  return fit_linear(columns, volumetric);
}

CriticalPart critical_part(const TestCurve& curve, const std::optional<double>& from) {
  constexpr double kLastPart = 0.75, kSteady = 0.1;
  constexpr std::size_t kLeast = 3;
  const double begin = from.value_or(kLastPart * curve.strain.back());
  CriticalPart part;
  while (part.first + 1 < curve.size() && curve.strain[part.first] < begin) ++part.first;
  const std::size_t n = curve.size() - part.first;
  const double strain = curve.strain.back() - curve.strain[part.first];
  const double volume = curve.volumetric.back() - curve.volumetric[part.first];
  if (n < kLeast)
    part.why_not = fmt::format(
        "the last part of the test, from a strain of {:.4g} on, has {} states: expected at least {} for a "
        "critical "
        "state",
        curve.strain[part.first], n, kLeast);
  else if (!(strain > 0.0) || std::abs(volume) > kSteady * strain)
    part.why_not = fmt::format(
        "the test has not reached a critical state: from a strain of {:.4g} on, the volumetric strain still "
        "changes by {:.3g}, which is {:.2g} times the change of the strain; expected at most {}",
        curve.strain[part.first], volume, std::abs(volume) / strain, kSteady);
  return part;
}

}  // namespace floc
