#pragma once

#include <Eigen/Core>

namespace floc {

// Samples of a loose powder collapse in jumps: 1/Phi of a sample is constant between two jumps, and each jump brings it
// back to the line of regime II, which has the slope lambda. Let the distances between jumps in ln P be exponentially
// distributed with the mean g. The lag of a sample behind the line is then lambda times an exponential variable with
// the mean g. The lags at two points have the correlation exp(-d/g), where d is the difference of ln P between the
// points. Let x be the distance in ln P from the pressure at which the first jumps can occur. The mean of the samples
// has the slope lambda only for x >> g. At smaller x, samples that have not jumped yet reduce the slope of the mean by
// lambda exp(-x/g).

/// Returns g, the mean distance in ln P between the jumps of a sample. It follows from the deviations of the samples
/// from their mean: over a step h of ln P, a deviation changes by an increment with the variance 2 lambda^2 g^2 [1 -
/// exp(-h/g)].
/// @param samples  values of 1/Phi; one row per point, one column per sample (two or more)
/// @param log_P    ln P of the points, growing
[[nodiscard]] double distance_of_jumps(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P,
                                       double lambda);

/// Returns the number of points at the beginning of regime II that a fit has to leave out, because the samples still
/// lag there. In ln P, these points lie less than 2 * distance beyond the first point. At least five points and two
/// fifths of the range of ln P remain.
/// @param distance  mean distance between the jumps
[[nodiscard]] int points_in_lag(const Eigen::VectorXd& log_P, double distance);

/// Returns whether the mean of samples becomes less steep at the point `end`: the slope of the points from `end` on is
/// smaller than the slope of the points before it, by more than four standard deviations of the difference. This
/// standard deviation is computed from the distance between the jumps, for two reasons. First, neighbouring points of
/// the mean are correlated, so that the residuals of the mean do not distinguish a bend from chance. Second, if the
/// error of the difference were computed from the scatter of a few samples, it would be inaccurate.
/// @param samples  values of 1/Phi; one row per point, one column per sample (two or more)
/// @param log_P    ln P of the points, growing
[[nodiscard]] bool samples_bend_at(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P, int end);

}  // namespace floc
