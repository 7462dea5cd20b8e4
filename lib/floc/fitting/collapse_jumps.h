#pragma once

#include <Eigen/Core>

namespace floc {

// Samples of a loose powder collapse in jumps. Between two jumps, 1/Phi of a sample is constant. Each jump brings the
// sample back to the line of regime II, along which 1/Phi falls by lambda per unit of ln P. The distances between jumps
// in ln P are assumed to be exponentially distributed, with the mean g. The lag of a sample behind the line is then
// lambda times an exponential variable with the mean g. The lags at two points have the correlation exp(-d/g), where d
// is the difference of ln P between the points. Let x be the distance in ln P from the pressure at which the first
// jumps can occur. The mean of the samples has the slope lambda only for x >> g. At smaller x, samples without a jump
// so far reduce the slope of the mean by lambda exp(-x/g).

/// Returns g, the mean distance in ln P between the jumps of a sample. It follows from the deviations of the samples
/// from their mean: between two points with a difference h of ln P, a deviation changes by an amount with the variance
/// 2 lambda^2 g^2 [1 - exp(-h/g)].
/// @param samples  values of 1/Phi; one row per point, one column per sample (two or more)
/// @param log_P    ln P of the points, growing
[[nodiscard]] double distance_of_jumps(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P,
                                       double lambda);

/// Returns the number of points at the beginning of regime II that a fit has to leave out, because the samples still
/// lag at these points: the points less than 2 * distance (in ln P) beyond the first point. At least five points and
/// two fifths of the range of ln P remain.
/// @param distance  mean distance between the jumps
[[nodiscard]] int points_in_lag(const Eigen::VectorXd& log_P, double distance);

/// Returns whether the mean of samples becomes less steep at the point `end`. Two slopes are compared: the slope of the
/// points from `end` on has to be smaller than the slope of the points before `end`, by more than two and a half
/// standard deviations of the difference. This standard deviation is computed from the distance between the jumps, for
/// two reasons. First, neighbouring points of the mean are correlated, so that the residuals of the mean do not
/// distinguish a bend from chance. Second, a standard deviation from the scatter of a few samples would be inaccurate.
/// @param samples  values of 1/Phi; one row per point, one column per sample (two or more)
/// @param log_P    ln P of the points, growing
[[nodiscard]] bool samples_bend_at(const Eigen::MatrixXd& samples, const Eigen::VectorXd& log_P, int end);

}  // namespace floc
