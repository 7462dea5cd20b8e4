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
  /// Smallest and largest `first` among the most probable places, which together have a probability of 95 %.
  int low95, high95;
  /// All places with a probability above 1 %, in the order of falling probability.
  std::vector<ChangePlace> places;
};

/// A possible place of the change between two regimes, just before the point `first`. The information criterion belongs
/// to the fit of one law before this place and of the next law after it.
struct Place {
  int first;
  double information;
};

/// Returns the change between two regimes, with its most probable place. The probability of a place is in proportion to
/// exp(-information/2).
/// @param shift  number that is added to the index of each place
ChangePoint change_among(std::vector<Place> places, int shift);

/// Residuals of 1/Phi below this value are due to the rounding of numbers in tables. They do not show which
/// consolidation law is better.
inline constexpr double kRoundingOfTables = 1e-9;

/// Regimes of a consolidation curve (1/Phi against the reduced pressure P*, with the solid fraction Phi). In regime I,
/// 1/Phi is constant (a plateau). In regime II, 1/Phi is linear in ln P*. In regime III, 1/Phi follows a power law of
/// P*.
struct Regimes {
  /// True if a constant, or a linear function of P* (elastic), explains 1/Phi better than any law of consolidation.
  bool all_in_one = false;
  int n_plateau = 0;  ///< number of points in the plateau of regime I
  /// End of regime I; absent if the points show that there is no plateau.
  std::optional<ChangePoint> plateau_end;
  /// Beginning of regime III; absent if the points do not distinguish regime III from the line of regime II.
  std::optional<ChangePoint> onset_three;
  int end_of_two = 0;  ///< index after the last point of regime II
  /// Samples that collapse in jumps lag behind the line at the beginning of regime II. Number of points with this lag,
  /// and mean distance in ln P between two jumps; both are 0 for the curve of a single sample.
  int n_lagging = 0;
  double jump_distance = 0.0;
};

/// Curve whose points are means over groups of neighbouring points. The search for regimes fits laws to all pairs of
/// ends, so that its cost grows with the third power of the number of points; tables of laboratories have thousands of
/// rows.
struct GroupedPoints {
  LawPoints points;
  int group_size = 1;  ///< number of points in a group; the last group may have fewer
};
/// Returns the means over groups, at most kMostPlaces of them. A curve with at most kMostPlaces points is unchanged.
[[nodiscard]] GroupedPoints grouped(const LawPoints& points);
/// Largest number of points, or groups of points, among which the ends of the regimes are sought.
inline constexpr int kMostPlaces = 500;

/// Returns regimes whose indices count single points, from regimes whose indices count groups.
/// @param n_points  number of single points
[[nodiscard]] Regimes by_point(Regimes regimes, int group_size, int n_points);

/// Finds the regimes of a consolidation curve. Each change between two regimes is put where a least-squares fit has the
/// smallest Bayesian information criterion.
///
/// 1. End of regime I: a constant followed by the full law is fitted to the points or, if it explains the points
/// better, a constant followed by the line of regime II. The constant is limited to the values of the law between the
/// last point of the plateau and the next point.
/// 2. Beginning of regime III: a line followed by a power law is fitted to the points after the plateau.
///
/// The probability of a place of a change is in proportion to exp(-criterion/2). Of more than kMostPlaces points, means
/// over groups are divided (grouped()).
/// @return the regimes; absent if no end of regime I leaves three points to regime II
[[nodiscard]] std::optional<Regimes> find_regimes(const LawPoints& points);

/// Returns whether the points show the bend of the full consolidation law: the solution `full` of this law explains the
/// points better than the line of regime II.
[[nodiscard]] bool detects_bend(const LawPoints& points, const LawSolution& full);

/// Returns true if the points show the bend of the full consolidation law and extend to pressures above P1*, where
/// regime III begins.
[[nodiscard]] bool detects_regime_three(const LawPoints& points, const LawSolution& full);

/// Returns the number of points at pressures below P1*, where regime III begins according to a solution of the
/// full law.
[[nodiscard]] int n_before_regime_three(const LawPoints& points, const LawSolution& full);

/// Returns whether a solution leaves at least three points to regime II. For the full law, regime II consists of the
/// points below P1*, where regime III begins. For all other laws, the result is true.
[[nodiscard]] bool keeps_regime_two(ConsolidationLaw law, const LawPoints& points, const LawSolution& solution);

/// Smallest number of pressures in regime II that determine the slope lambda.
inline constexpr int kMinInRegimeTwo = 3;

}  // namespace floc
