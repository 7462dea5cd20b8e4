#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/consolidation_solver.h"
#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/profile_likelihood.h"

namespace floc {

/// A consolidation law fitted to a window of points, from which its parameters and their errors follow. The coordinates
/// of the fit are theta and, if there is a plateau before the window, the level of 1/Phi on the plateau.
struct LawEstimate {
  ConsolidationLaw law;
  LawPoints points;
  LawSolution solution;
  LawPoints plateau;     ///< points of the plateau of regime I; empty if there is none
  double plateau_level;  ///< weighted mean of 1/Phi over the points of the plateau

  bool has_plateau() const { return plateau.size() > 0; }
};

/// Converts the coordinates theta of a law to another first pressure, to which they refer: the law is unchanged, and ln
/// P of the first pressure grows by `step`.
Eigen::VectorXd at_first_pressure(ConsolidationLaw law, Eigen::VectorXd theta, double step);

/// Returns the weighted mean of 1/Phi over the points; NaN if there are none.
double mean_level(const LawPoints& points);

/// A parameter of the law with its gradient with respect to the coordinates of the fit.
struct Quantity {
  std::string name;
  bool is_inverse;  ///< true if the parameter is 1/value, false if it is exp(value)
  double value;
  Eigen::VectorXd gradient;  ///< derivatives of `value` with respect to the coordinates of the fit

  double parameter() const;
};

/// Returns the parameters of a law; the first ones correspond to the entries of theta. P0* is left out if there is no
/// plateau, because it is then given, not fitted.
std::vector<Quantity> quantities_of(const LawEstimate& estimate);

/// Covariance of the coordinates of a fit, and the number of degrees of freedom of this covariance.
struct Covariance {
  Eigen::MatrixXd matrix;
  int dof;
};

/// Returns the covariance of the coordinates as (J^T J)^-1 times the residual variance, with J the Jacobian of the
/// weighted residuals.
Covariance covariance_from_residuals(const LawEstimate& estimate);

/// Returns the covariance of the coordinates of the fit to a mean of samples, computed from the changes of the
/// coordinates that the deviation of each sample causes in the linearised fit.
/// @param deviations  deviation of 1/Phi of each sample from the mean; the rows are the points of the plateau, then of
/// the window, the columns are two samples or more
Covariance covariance_from_samples(const LawEstimate& estimate, const Eigen::MatrixXd& deviations);

/// Returns a parameter with its standard error and an interval by Student's t.
FittedParameter fitted_parameter(const Quantity& quantity, const Covariance& covariance);

/// Returns the 95 % interval of one coordinate of theta from the profile of the sum of squares. At the ends of the
/// interval, the best fit with this coordinate fixed has a sum of squares that exceeds the minimum by t95^2 times the
/// residual variance (t95 by Student's t), times the ratio of the variance of the coordinate in `covariance` to its
/// variance from the residuals. An end is absent if the data allow any value on that side.
ProfileInterval profile_interval(const LawEstimate& estimate, int coordinate, const Covariance& covariance);

}  // namespace floc
