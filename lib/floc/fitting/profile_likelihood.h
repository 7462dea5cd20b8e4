#pragma once

#include <functional>
#include <optional>

namespace floc {

/// An interval by the profile of a sum of squares. An end is absent if the data allow any value on that side, as
/// far as the profile can be followed.
struct ProfileInterval {
  std::optional<double> low, high;
};

/// Settings of the search for the ends of such an interval.
struct ProfileSearch {
  double center;             ///< the coordinate at the solution
  double least;              ///< sum of squares there
  double allowed;            ///< sum of squares at the ends of the interval, > least
  double low_end, high_end;  ///< beyond these the coordinate no longer means anything
  double step;               ///< first step away from the solution, > 0
};

/// Least sum of squares with the coordinate held at a value; infinite where the solver fails. It may follow the
/// solution from one call to the next.
using ProfileFunction = std::function<double(double value)>;

/// Where the profile reaches what is allowed, to 1e-3 of the width.
/// @param profile_from_solution  a profile that starts at the solution, one for each side
[[nodiscard]] ProfileInterval profile_interval(const ProfileSearch& search,
                                               const std::function<ProfileFunction()>& profile_from_solution);

}  // namespace floc
