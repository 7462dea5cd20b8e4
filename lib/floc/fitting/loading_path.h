#pragma once

#include <string>
#include <vector>

#include "floc/fitting/consolidation.h"

namespace floc {

/// Relative difference below which two pressures count as equal.
inline constexpr double kSamePressure = 1e-3;

/// Kind of load in one row of the table of a load path.
enum class PathLoad {
  isotropic,
  /// One axis is driven, and the sides of the cell along the other axes are constant. P_star may be the stress on the
  /// driven axis.
  oedometric,
  other,  ///< any other load that differs between the axes; such a row is no point of a consolidation curve
};

/// One row of the table of a load path.
struct PathRow {
  std::string branch;  ///< name of the branch; empty if the table has no branches
  double P_star;
  double phi;
  PathLoad load = PathLoad::isotropic;
  /// Stress on the driven axis divided by the mean stress, for an oedometric row.
  double driven_over_mean = 1.0;
};

/// Kind of the change of pressure from the previous row of a load path to a row.
enum class PathStep {
  zero_pressure,  ///< P* = 0
  first_loading,  ///< assembly of the packing, and first loading
  unloading,
  reloading,     ///< loading after an unloading, up to the largest earlier pressure
  later_virgin,  ///< loading after an unloading, beyond the largest earlier pressure
  hold,          ///< the pressure is constant
  test,          ///< the load differs between the axes, but not as in an oedometer test
};

/// Returns, for each row, the kind of the step from the previous row to this row. The kinds follow from the loads and
/// the pressures, not from the names of the branches. If successive isotropic rows of one branch have the same
/// pressure, as in a table of a laboratory while the sample creeps, only the last of these rows is used; the others
/// have the kind PathStep::hold.
std::vector<PathStep> path_steps(const std::vector<PathRow>& rows);

/// Returns the indices of the rows that are not used because the next row of the branch has the same pressure.
std::vector<int> superseded_rows(const std::vector<PathRow>& rows);

/// Returns how often the pressure of a load path changes from growing to falling or back.
int count_reversals(const std::vector<PathRow>& rows);

/// A row of a load path whose pressure does not fit its branch, with a text that describes the expected pressure.
struct PathFault {
  int row;
  std::string expected;
};

/// Returns the first row whose pressure does not fit its branch, or nothing. A branch consists of consecutive rows with
/// the same branch name. Along a branch, the pressure must not change its direction (from growing to falling, or back).
/// It must not fall in a branch "load", and must not grow in a branch "unload". Rows without branch names always fit.
/// Rows whose load differs between the axes always fit too, because the stress on an axis with an imposed strain may
/// fall.
std::optional<PathFault> path_fault(const std::vector<PathRow>& rows);

/// Rows of a load path as a consolidation curve.
struct Loading {
  ConsolidationCurve curve;
  std::vector<int> rows;  ///< for each point of the curve: index of its row
};

/// Returns the rows of the first loading, which path_steps() finds from the pressures. If there is a branch "load",
/// only two kinds of rows count: the rows of the first branch "load", and the rows of "assembly" before it. If `virgin`
/// is true, the rows of later loadings at pressures above the largest earlier pressure are added.
Loading first_loading(const std::vector<PathRow>& rows, bool virgin = false);

/// A loading that starts again after an unloading.
struct Reloading {
  Loading loading;        ///< rows from the lowest pressure on, also beyond `largest_before`
  double largest_before;  ///< largest pressure before the reloading
};
std::vector<Reloading> reloadings(const std::vector<PathRow>& rows);

/// Returns the unloadings of a load path. The first row of an unloading is the row from which the pressure falls. Rows
/// with P* = 0 are left out.
std::vector<Loading> unloadings(const std::vector<PathRow>& rows);

/// Returns the mean of the inverse solid fraction 1/Phi over samples. The points of the mean are the pressures that
/// occur in all samples (to 0.1 %). The result is empty if there are no such pressures.
ConsolidationCurve mean_curve(const std::vector<ConsolidationCurve>& samples);

}  // namespace floc
