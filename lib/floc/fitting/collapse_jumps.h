#pragma once

#include <Eigen/Core>

namespace floc {

// Samples of a loose powder collapse in jumps: 1/Phi of a sample is constant between two jumps, and each jump brings it
// back to the line of regime II, which has the slope lambda. Let the distances between jumps in ln P be exponentially
// distributed with the mean g. The lag of a sample behind the line is then lambda times an exponential variable of the
// mean g. The correlation of the lags at two points falls off as exp(-d/g) with the distance d of the points in ln P.
// The mean of the samples has the slope lambda only at a distance d >> g beyond the pressure at which the first jumps
// can occur. At smaller d, samples that have not jumped yet reduce the slope of the mean by lambda exp(-d/g).

/// Returns g, the mean distance between the jumps of samples in ln P. With this g, the deviations of the samples from
/// their mean change over a step h of ln P by increments of the variance 2 lambda^2 g^2 [1 - exp(-h/g)].
/// @param samples  1/Phi of points (rows) of samples (columns, two or more)   @param log_P  ln P of the points, growing
[[nodiscard]] double distance_of_jumps(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P,
                                       double lambda);

/// Returns the number of points to leave out at the beginning of regime II because the samples still lag there: points
/// less than 2 `distance` beyond the first point in ln P. At least five points and two fifths of the range of ln P
/// remain.
/// @param distance  mean distance between the jumps
[[nodiscard]] int points_in_lag(const Eigen::VectorXd& log_P, double distance);

/// Returns whether the mean of samples becomes less steep at the point `end`: the slope of the points from `end` on is
/// smaller than the slope of the points before it, by more than four standard deviations of the difference. This
/// standard deviation is computed from the distance between the jumps, for two reasons. First, neighbouring points of
/// the mean are correlated, so that the residuals of the mean do not distinguish a bend from chance. Second, the
/// scatter of a few samples gives only an inaccurate error of a single difference.
/// @param samples  1/Phi of points (rows) of samples (columns, two or more)   @param log_P  ln P of the points, growing
[[nodiscard]] bool samples_bend_at(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P, int end);

}  // namespace floc
