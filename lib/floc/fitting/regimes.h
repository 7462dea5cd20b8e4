#pragma once

#include <optional>
#include <vector>

#include "floc/fitting/consolidation_solver.h"

namespace floc {

/// A possible place of the change from one regime of consolidation to the next, and its probability.
struct ChangePlace {
  int first;
  double probability;
};

/// Change from one regime of consolidation to the next, between two neighbouring points.
struct ChangePoint {
  int first;  ///< index of the first point after the most probable change
  /// Smallest and largest `first` among the most probable places of the change, which together have a probability of 95
  /// %.
  int low95, high95;
  std::vector<ChangePlace> places;  ///< all places more probable than 1 %, the most probable first
};

/// A possible place of the change between two regimes, just before the point `first`, and the information criterion of
/// the fit in which one law ends there and the next law begins.
struct Place {
  int first;
  double information;
};

/// Returns the change between two regimes: the most probable of its possible places, and all places more probable than
/// 1 %. The probability of a place is in proportion to exp(-information/2).
/// @param shift  number that is added to all indices
ChangePoint change_among(std::vector<Place> places, int shift);

/// Residuals of 1/Phi below this value are due to the rounding of the numbers in a table, and do not distinguish
/// between consolidation laws.
inline constexpr double kRoundingOfTables = 1e-9;

/// Regimes of a consolidation curve, that is, of 1/Phi against the reduced pressure P* (Phi is the solid fraction).
/// Regime I is a plateau; in regime II, 1/Phi is linear in ln P*; regime III is a power law of P*.
struct Regimes {
  /// True if a constant, or a linear function of P* (elastic), explains 1/Phi better than any law of consolidation.
  bool all_in_one = false;
  int n_plateau = 0;  ///< number of points in the plateau of regime I
  /// end of regime I; absent if the points show that there is no plateau
  std::optional<ChangePoint> plateau_end;
  /// Beginning of regime III; absent if the points do not distinguish regime III from the line of regime II.
  std::optional<ChangePoint> onset_three;
  int end_of_two = 0;  ///< index after the last point of regime II
  /// Number of points at the beginning of regime II at which samples that collapse in jumps lag behind the line of
  /// regime II, and mean distance in ln P between two jumps. Both are 0 for the curve of a single sample.
  int n_lagging = 0;
  double jump_distance = 0.0;
};

/// Finds the regimes of a consolidation curve by a change-point search with least squares: each change is put where the
/// fit has the smallest Bayesian information criterion.
///
/// 1. End of regime I: a constant followed by the full law is fitted to the points. If a constant followed by the line
/// of regime II explains the points better, it is fitted instead. The constant must be a value that the law takes
/// between the last point of the plateau and the next point.
/// 2. Beginning of regime III: a line followed by a power law is fitted to the points after the plateau.
///
/// The probability of a place of a change is in proportion to exp(-criterion/2).
/// @return the regimes; absent if no end of regime I leaves three points to regime II
[[nodiscard]] std::optional<Regimes> find_regimes(const LawPoints& points);

/// Returns whether the points show the bend of the full consolidation law: whether `full`, the solution of this law,
/// explains the points better than the line of regime II.
[[nodiscard]] bool detects_bend(const LawPoints& points, const LawSolution& full);

/// Returns true if the points show the bend of the full consolidation law and extend to pressures above P1*, where
/// regime III begins.
[[nodiscard]] bool detects_regime_three(const LawPoints& points, const LawSolution& full);

/// Returns the number of points at pressures below P1*, where regime III begins according to a solution of the
/// full law.
[[nodiscard]] int n_before_regime_three(const LawPoints& points, const LawSolution& full);

/// Returns whether a solution leaves at least three points to regime II. For the full law these are the points below
/// P1*, where regime III begins; for any other law the result is true.
[[nodiscard]] bool keeps_regime_two(ConsolidationLaw law, const LawPoints& points, const LawSolution& solution);

/// Smallest number of pressures in regime II from which its slope lambda is determined.
inline constexpr int kMinInRegimeTwo = 3;

}  // namespace floc
