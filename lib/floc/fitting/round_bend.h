#pragma once

#include <Eigen/Core>

namespace floc {

/// Two straight lines that pass into each other in a round bend:
///
///   y = level + slope_below (x - bend) + (slope_above - slope_below) s(x - bend),  s(d) = width ln[1 + exp(d/width)]
///
/// The lines meet at x = bend. With width = 0 the bend is sharp, s(d) = max(d, 0).
struct RoundBend {
  double bend = 0.0, width = 0.0;
  double level = 0.0, slope_below = 0.0, slope_above = 0.0;
  double sum_of_squares = 0.0;

  double at(double x) const;
};

/// Least-squares fit of a round bend, with its profile: the smallest sum of squares for each position of the bend.
struct RoundBendFit {
  RoundBend best;
  /// Positions of the bend on a grid from the second x to the second-last x, and the smallest sum of squares for each
  /// position.
  Eigen::VectorXd places, profile;
  Eigen::VectorXd residuals;  ///< data minus fit
  /// Derivatives of the fit with respect to level, slope_below, slope_above, bend and width (left out if the width is
  /// 0).
  Eigen::MatrixXd jacobian;
};

/// Fits a round bend. The width is varied from 0, a sharp bend, to a tenth of the range of x.
/// @param x         increasing values; five or more
/// @param is_round  whether the width is fitted; otherwise the bend is sharp
[[nodiscard]] RoundBendFit fit_round_bend(const Eigen::ArrayXd& x, const Eigen::VectorXd& y, bool is_round);

}  // namespace floc
