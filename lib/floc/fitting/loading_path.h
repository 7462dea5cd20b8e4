#pragma once

#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"

namespace floc {

/// Pressures that differ by less than this share are the same one.
inline constexpr double kSamePressure = 1e-3;

/// Kind of load of a row of a path.
enum class PathLoad {
  isotropic,
  oedometric,  ///< one axis is driven, the others keep their lengths; P_star may be the driven stress
  other,       ///< axes are loaded differently in another way: no consolidation
};

/// One row of a path table.
struct PathRow {
  std::string branch;  ///< empty in a table without branches
  double P_star;
  double phi;
  PathLoad load = PathLoad::isotropic;
  double driven_over_mean = 1.0;  ///< driven over mean stress, of an oedometric row
};

/// Kind of step of a row of a path.
enum class PathStep {
  zero_pressure,  ///< P* = 0
  first_loading,  ///< assembly and the first loading
  unloading,
  reloading,     ///< later loading, up to the largest earlier pressure
  later_virgin,  ///< later loading, beyond the largest earlier pressure
  hold,          ///< pressure kept
  test,          ///< axes are loaded differently, not as in an oedometer
};

/// Returns the kinds of all rows from their pressures alone; a row at which the pressure turns begins a new
/// branch.
std::vector<PathStep> path_steps(const std::vector<PathRow>& rows);

/// A fault of a path: the row, and the value expected there.
struct PathFault {
  int row;
  std::string expected;
};

/// Returns the first row that does not fit its branch, or nothing. In a run of rows with one name, pressures
/// must strictly grow, strictly fall, or all be the same (a hold); without names no pressure may be repeated.
/// Rows with different loads on the axes always fit, since the stress on a strained axis may fall.
std::optional<PathFault> path_fault(const std::vector<PathRow>& rows);

/// Rows that consolidation is fitted to.
struct Loading {
  ConsolidationCurve curve;
  std::vector<int> rows;  ///< index of the row of each point
};

/// Returns the rows of the first loading; with `virgin`, also those of later loadings beyond the largest
/// pressure before. The first loading is found from the pressures; where branches are named and one is "load",
/// it consists of "assembly" and the first run of "load" only.
Loading first_loading(const std::vector<PathRow>& rows, bool virgin = false);

/// A loading that starts again from a smaller pressure.
struct Reloading {
  Loading loading;        ///< rows from the point where the pressure turns: reloading, and loading beyond it
  double largest_before;  ///< largest pressure before it
};
std::vector<Reloading> reloadings(const std::vector<PathRow>& rows);

/// Returns the runs of falling pressure, each from the point where the pressure turns; P* = 0 is left out.
std::vector<Loading> unloadings(const std::vector<PathRow>& rows);

/// Returns the mean of 1/Phi over samples at each pressure that all of them have (to 0.1 %); no points if there
/// is none.
ConsolidationCurve mean_curve(const std::vector<ConsolidationCurve>& samples);

}  // namespace floc
