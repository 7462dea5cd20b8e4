#pragma once

#include <Eigen/Core>

namespace floc {

/// Natural cubic smoothing spline f of points (x, y): the function that minimises sum (y - f(x))^2 + mu integral f''^2.
/// The weight mu minimises the score of generalised cross-validation [CW1979]. In this score, the degrees of freedom of
/// the spline are multiplied by 1.4, so that the spline seldom follows the noise. For a given mu, values and
/// derivatives of the spline are linear functions of y: matrices multiplied by y. The matrices also serve for other y
/// at the same x.
class SmoothingSpline {
 public:
  /// @param x  increasing values; four or more
  SmoothingSpline(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

  /// Returns the matrix that is multiplied by y to obtain the values of the spline at x.
  const Eigen::MatrixXd& smoother() const { return smoother_; }

  /// Matrices that are multiplied by y to obtain values, slopes and second derivatives of the spline at given
  /// positions.
  struct Operators {
    Eigen::MatrixXd value, slope, curvature;
  };
  /// @param at  positions between the first and the last x
  [[nodiscard]] Operators operators(const Eigen::VectorXd& at) const;

 private:
  Eigen::VectorXd x_;
  /// Matrices that are multiplied by y to obtain values and second derivatives of the spline at x.
  Eigen::MatrixXd smoother_, second_;
};

}  // namespace floc
