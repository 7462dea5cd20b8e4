#pragma once

#include <optional>
#include <vector>

#include "floc/fitting/consolidation_solver.h"

namespace floc {

/// A possible change from one regime to the next, before the point `first`.
struct ChangePlace {
  int first;
  double probability;
};

/// Change from one regime to the next, between two neighbouring points.
struct ChangePoint {
  int first;                        ///< index of the first point after the most probable change
  int low95, high95;                ///< range of that index over the most probable places, 95 % together
  std::vector<ChangePlace> places;  ///< all places more probable than 1 %, the most probable first
};

/// The regimes of a curve: a plateau (I), a line in ln P* (II), a power law (III).
struct Regimes {
  /// A constant, or a solid fraction linear in P* (elastic), explains the points better than any law of
  /// consolidation.
  bool all_in_one = false;
  int n_plateau = 0;                       ///< points of regime I
  std::optional<ChangePoint> plateau_end;  ///< present if there is, or may be, a plateau
  std::optional<ChangePoint> onset_three;  ///< present if the points distinguish regime III from the line
  int end_of_two = 0;                      ///< index after the last point of regime II
};

/// Finds the regimes by a change-point search with least squares. The end of the plateau is the split into a
/// constant and the full law (or the line, where that explains more) of least Bayesian information criterion;
/// the level of the plateau has to be one that the law takes between the plateau's last point and the next. The
/// onset of III is the split of the rest into a line and a power law of least criterion. Places are weighted by
/// exp(-criterion/2).
/// @return the regimes; absent if no split leaves three points to regime II
[[nodiscard]] std::optional<Regimes> find_regimes(const LawPoints& points);

/// True if the points distinguish the full law, whose solution on them is given, from the line of regime II.
[[nodiscard]] bool detects_bend(const LawPoints& points, const LawSolution& full);

/// True if the points distinguish the full law from the line and also reach beyond its P1*.
[[nodiscard]] bool detects_regime_three(const LawPoints& points, const LawSolution& full);

/// Number of points at pressures below the P1* of a solution of the full law.
[[nodiscard]] int n_before_regime_three(const LawPoints& points, const LawSolution& full);

/// False for a solution of the full law that has lost regime II: fewer than three points before its P1*.
[[nodiscard]] bool keeps_regime_two(ConsolidationLaw law, const LawPoints& points, const LawSolution& solution);

/// Fewest pressures in regime II from which its slope is taken.
inline constexpr int kMinInRegimeTwo = 3;

}  // namespace floc
