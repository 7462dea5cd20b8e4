#pragma once

#include <Eigen/Core>

namespace floc {

// Samples of a loose powder collapse in jumps: 1/Phi of each stays, and catches up with the line of regime II from time to
// time. If the distances of the jumps in ln P are exponentially distributed with the mean g, each sample lags behind the
// line by a slope lambda times an exponential variable of the mean g, whose correlation falls off as exp(-d/g) with the
// distance d. The mean of the samples then follows the line of the slope lambda, but only d >> g after the first jumps
// could occur: before that, samples that have not jumped yet make it less steep by lambda exp(-d/g).

/// Returns the mean distance of the jumps of samples in ln P, for which the increments of their deviations from the mean
/// have the variance 2 lambda^2 g^2 [1 - exp(-h/g)] over steps h of ln P.
/// @param samples  1/Phi of points (rows) of samples (columns, two or more)   @param log_P  ln P of the points, growing
[[nodiscard]] double distance_of_jumps(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P,
                                       double lambda);

/// Returns the number of points at the beginning of regime II to leave out, in which the samples still lag: those within two
/// distances of the jumps from the first point. At least five points and two fifths of the range of ln P stay.
[[nodiscard]] int points_in_lag(const Eigen::VectorXd& log_P, double distance);

/// Returns whether the mean of samples becomes less steep at the point `end`: its slope from there on is less than that over
/// the points before it by more than four standard deviations of the difference. These are computed from the distance of the
/// jumps, because neighbouring points of the mean are correlated, so that its residuals do not tell a bend from chance, and
/// because the scatter of a few samples determines the error of a single difference badly.
/// @param samples  1/Phi of points (rows) of samples (columns, two or more)   @param log_P  ln P of the points, growing
[[nodiscard]] bool samples_bend_at(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P, int end);

}  // namespace floc
