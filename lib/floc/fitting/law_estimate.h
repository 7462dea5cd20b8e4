#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/consolidation_solver.h"
#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/profile_likelihood.h"

namespace floc {

/// A law solved on a window, from which its parameters and their errors follow. The coordinates are theta and,
/// with a plateau before the window, its level of 1/Phi.
struct LawEstimate {
  ConsolidationLaw law;
  LawPoints points;
  LawSolution solution;
  LawPoints plateau;     ///< points of regime I; empty without one
  double plateau_level;  ///< weighted mean of their 1/Phi

  bool has_plateau() const { return plateau.size() > 0; }
};

/// Returns theta of a law whose first pressure moves by `step` in ln P.
Eigen::VectorXd at_first_pressure(ConsolidationLaw law, Eigen::VectorXd theta, double step);

/// Returns the weighted mean of 1/Phi; NaN without points.
double mean_level(const LawPoints& points);

/// A parameter as a function of the coordinates.
struct Quantity {
  std::string name;
  bool is_inverse;  ///< the parameter is 1/value, else exp(value)
  double value;
  Eigen::VectorXd gradient;  ///< derivatives of `value` by the coordinates

  double parameter() const;
};

/// Returns the parameters of a law: the free ones first, as many as theta has. P0* is left out where it is
/// held.
std::vector<Quantity> quantities_of(const LawEstimate& estimate);

/// Covariance of the coordinates, and the number of degrees of freedom from which it was estimated.
struct Covariance {
  Eigen::MatrixXd matrix;
  int dof;
};

/// Returns the covariance (J^T J)^-1 times the residual variance.
Covariance covariance_from_residuals(const LawEstimate& estimate);

/// Returns the covariance from the samples whose mean the points are: the deviation of each is carried through
/// the linearised fit.
/// @param deviations  of 1/Phi from the mean, points of plateau and window x samples; two samples or more
Covariance covariance_from_samples(const LawEstimate& estimate, const Eigen::MatrixXd& deviations);

/// Returns a parameter with its standard error and an interval by Student's t.
FittedParameter fitted_parameter(const Quantity& quantity, const Covariance& covariance);

/// Returns the interval of one coordinate of theta from the profile of the sum of squares. At its ends the best
/// fit with the coordinate held is worse by t95^2 residual variances, times the ratio of the coordinate's
/// variance in `covariance` to its variance from the residuals. An end is absent if the data allow any value on
/// that side.
ProfileInterval profile_interval(const LawEstimate& estimate, int coordinate, const Covariance& covariance);

}  // namespace floc
