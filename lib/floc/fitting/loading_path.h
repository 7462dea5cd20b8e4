#pragma once

#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"

namespace floc {

/// Pressures that differ by less than this share are the same one.
inline constexpr double kSamePressure = 1e-3;

/// How a row of a path is loaded.
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

/// What a row of a path does.
enum class PathStep {
  zero_pressure,  ///< P* = 0
  first_loading,  ///< assembly and the first loading
  unloading,
  reloading,     ///< up to the largest earlier pressure
  later_virgin,  ///< of a later loading, beyond the largest earlier pressure
  hold,          ///< pressure kept
  test,          ///< axes are loaded differently, not as in an oedometer
};

/// Steps of all rows by their pressures alone; a row that turns back begins a new branch.
std::vector<PathStep> path_steps(const std::vector<PathRow>& rows);

/// A fault of a path: which row, and what was expected there.
struct PathFault {
  int row;
  std::string expected;
};

/// The first row that breaks its branch: in a run of rows with one name pressures must strictly grow, strictly
/// fall, or all be the same (a hold); without names no pressure is repeated. Rows with different loads on the
/// axes break none: what a strained axis carries may fall. Absent if there is none.
std::optional<PathFault> path_fault(const std::vector<PathRow>& rows);

/// Rows that consolidation is fitted to.
struct Loading {
  ConsolidationCurve curve;
  std::vector<int> rows;  ///< index of the row of each point
};

/// The first loading; with `virgin`, also what later loadings add beyond it. The first loading is that of the
/// pressures; where branches are named and one is "load", only "assembly" and the first run of "load".
Loading first_loading(const std::vector<PathRow>& rows, bool virgin = false);

/// A loading that starts again from a smaller pressure.
struct Reloading {
  Loading loading;        ///< from the point where it turns, reloading and what goes on beyond
  double largest_before;  ///< largest pressure before it
};
std::vector<Reloading> reloadings(const std::vector<PathRow>& rows);

/// Runs of falling pressure, each from the point where it turns; P* = 0 is left out.
std::vector<Loading> unloadings(const std::vector<PathRow>& rows);

/// Mean of 1/Phi over samples at each pressure that all of them have (to 0.1 %); no points if there is none.
ConsolidationCurve mean_curve(const std::vector<ConsolidationCurve>& samples);

}  // namespace floc
