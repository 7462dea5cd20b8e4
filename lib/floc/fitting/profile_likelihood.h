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
  double center;             ///< coordinate at the solution
  double least;              ///< sum of squares at the solution
  double allowed;            ///< sum of squares at the ends of the interval, > least
  double low_end, high_end;  ///< beyond these the coordinate no longer means anything
  double step;               ///< first step away from the solution, > 0
};

/// Function that returns the least sum of squares with the coordinate held at a value; infinite where the
/// solver fails. It may start from the solution of the call before.
using ProfileFunction = std::function<double(double value)>;

/// Finds the ends of the interval, where the profile reaches `search.allowed`, to 1e-3 of its width.
/// @param profile_from_solution  returns a profile that starts at the solution; called once for each side
[[nodiscard]] ProfileInterval profile_interval(const ProfileSearch& search,
                                               const std::function<ProfileFunction()>& profile_from_solution);

}  // namespace floc
