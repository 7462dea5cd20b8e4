#include "floc/fitting/profile_likelihood.h"

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// Returns the coordinate at which the profile of the sum of squares reaches `search.allowed` on one side of the
/// solution. First, growing steps, beginning with `step` (signed), bracket this coordinate. The method of false
/// position then finds the coordinate. This method works best for linear functions. It is therefore applied to the
/// square root of the increase of the sum of squares, which is nearly linear in the coordinate. The result is absent if
/// the profile does not reach `search.allowed` up to `end`, or if the solver fails before.
std::optional<double> crossing(const ProfileSearch& search, double step, double end,
                               const ProfileFunction& profile) {
  const double target = std::sqrt(search.allowed - search.least);
  const auto miss = [&](double at) { return std::sqrt(std::max(profile(at) - search.least, 0.0)) - target; };
  double inside = search.center;
  double miss_inside = -target;
  double outside = inside;
  double miss_outside = -target;
  while (miss_outside < 0.0) {
    if (outside == end) return std::nullopt;
    inside = outside;
    miss_inside = miss_outside;
    outside += step;
    step *= 1.6;
    if ((end - outside) * step < 0.0) outside = end;
    miss_outside = miss(outside);
  }
  constexpr int kRounds = 40;
  // Relative accuracy of the distance from the solution to the end of the interval.
  constexpr double kAccuracy = 1e-3;
  for (int round = 0; round < kRounds; ++round) {
    const double share = std::isfinite(miss_outside) ? miss_inside / (miss_inside - miss_outside) : 0.5;
    const double middle = inside + std::clamp(share, 0.05, 0.95) * (outside - inside);
    const double m = miss(middle);
    (m < 0.0 ? inside : outside) = middle;
    (m < 0.0 ? miss_inside : miss_outside) = m;
    if (std::abs(m) < kAccuracy * target) return middle;
  }
  if (!std::isfinite(miss_outside)) return std::nullopt;
  return 0.5 * (inside + outside);
}

}  // namespace

ProfileInterval profile_interval(const ProfileSearch& search,
                                 const std::function<ProfileFunction()>& profile_from_solution) {
  ProfileInterval interval;
  if (search.center > search.low_end)
    interval.low = crossing(search, -search.step, search.low_end, profile_from_solution());
  if (search.center < search.high_end)
    interval.high = crossing(search, search.step, search.high_end, profile_from_solution());
  return interval;
}

}  // namespace floc
