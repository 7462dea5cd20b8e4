#pragma once

#include <functional>
#include <optional>

namespace floc {

/// Interval of a coordinate of a least-squares fit, from the profile of the sum of squares. An end is absent if, on
/// that side, the data allow all values for which the profile can be computed.
struct ProfileInterval {
  std::optional<double> low, high;
};

/// Settings of the search for the ends of a ProfileInterval.
struct ProfileSearch {
  double center;             ///< value of the coordinate at the solution
  double least;              ///< sum of squares at the solution
  double allowed;            ///< sum of squares at the ends of the interval, > least
  double low_end, high_end;  ///< limits of the search; beyond them, the coordinate has no meaningful values
  double step;               ///< first step away from the solution, > 0
};

/// Profile of the sum of squares: a function that fixes one coordinate at `value`, fits all other coordinates, and
/// returns the sum of squares; infinity if the solver fails. The function may start the solver from the solution of the
/// previous call.
using ProfileFunction = std::function<double(double value)>;

/// Finds the ends of a ProfileInterval, where the profile of the sum of squares reaches `search.allowed`. The ends are
/// accurate to about 1e-3 of their distance from the solution.
/// @param profile_from_solution  function that returns a new profile, for each end of the interval; the first call of a
/// profile starts from the solution of the fit
[[nodiscard]] ProfileInterval profile_interval(const ProfileSearch& search,
                                               const std::function<ProfileFunction()>& profile_from_solution);

}  // namespace floc
