#pragma once

#include <Eigen/Core>

namespace floc {

/// Natural cubic smoothing spline f of points (x, y): the function with the smallest sum (y - f(x))^2 + mu integral f''^2.
/// The weight mu has the smallest score of generalised cross-validation [CW1979], in which the degrees of
/// freedom of the spline count 1.4 times, so that it seldom follows the noise. Values and derivatives are linear
/// functions of y, so that the spline of other y with the same mu costs a product with a matrix.
class SmoothingSpline {
 public:
  /// @param x  growing, four points or more
  SmoothingSpline(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

  /// Returns the matrix that turns y into the values of the spline at x.
  const Eigen::MatrixXd& smoother() const { return smoother_; }

  /// Matrices that turn y into values, slopes and second derivatives of the spline at other places.
  struct Operators {
    Eigen::MatrixXd value, slope, curvature;
  };
  /// @param at  places between the first and the last x
  [[nodiscard]] Operators operators(const Eigen::VectorXd& at) const;

 private:
  Eigen::VectorXd x_;
  Eigen::MatrixXd smoother_, second_;  ///< from y to values and to second derivatives at x
};

}  // namespace floc
