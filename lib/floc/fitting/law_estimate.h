#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/consolidation_solver.h"
#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/profile_likelihood.h"
#include "floc/fitting/recompression.h"

namespace floc {

/// A consolidation law fitted to a range of points. The coordinates of the fit are theta (LawSolution) and, if there
/// are points before regime II, the level of the recompression line through these points and its slope kappa (if kappa
/// was fitted). The parameters of the law are functions of the coordinates.
struct LawEstimate {
  ConsolidationLaw law;
  LawPoints points;
  LawSolution solution;
  LawPoints plateau;  ///< points of the plateau or recompression line before regime II; empty if there are none
  RecompressionLine line;  ///< line through the points of the plateau

  bool has_plateau() const { return plateau.size() > 0; }
  /// Returns the number of coordinates of the fit.
  Eigen::Index n_coordinates() const {
    return solution.theta.size() + (has_plateau() ? 1 : 0) + (line.slopes ? 1 : 0);
  }
};

/// Converts the coordinates theta of a consolidation law, which refer to the first pressure fitted, to another
/// reference pressure. The law does not change.
/// @param step  ln of the other pressure minus ln of the first pressure fitted
Eigen::VectorXd at_first_pressure(ConsolidationLaw law, Eigen::VectorXd theta, double step);

/// A parameter of a consolidation law, with its gradient with respect to the coordinates of the fit.
struct Quantity {
  std::string name;
  bool is_inverse;  ///< true if the parameter is 1/value, false if it is exp(value)
  double value;
  Eigen::VectorXd gradient;  ///< derivatives of `value` with respect to the coordinates of the fit
  /// Whether the parameter of the mean curve is the mean of the parameters of the samples. For the slope of a line, for
  /// example, this is the case.
  bool is_mean = false;

  double parameter() const;
};

/// Returns the parameters of a fitted consolidation law. The first ones correspond to the entries of theta. P0* is the
/// pressure at which the line of regime II begins. It is left out if there is no plateau, because P0* is then given and
/// not fitted.
std::vector<Quantity> quantities_of(const LawEstimate& estimate);

/// Covariance of the coordinates of a fit, with its number of degrees of freedom.
struct Covariance {
  Eigen::MatrixXd matrix;
  int dof;
  bool is_of_samples = false;  ///< whether the covariance was computed from the scatter between samples
};

/// Returns the covariance of the coordinates as (J^T J)^-1 times the residual variance, with J the Jacobian of the
/// weighted residuals.
Covariance covariance_from_residuals(const LawEstimate& estimate);

/// Returns the covariance of the coordinates if the law was fitted to a mean of samples. In the linearised fit, the
/// deviation of each sample from the mean changes the coordinates; the covariance follows from these changes.
/// @param deviations  deviation of 1/Phi of each sample from the mean over samples. Rows: the points of the plateau,
/// then the other points fitted; columns: two samples or more
Covariance covariance_from_samples(const LawEstimate& estimate, const Eigen::MatrixXd& deviations);

/// Returns the slope kappa of the recompression line with its 95 % interval, which is limited to positive
/// values. @pre the slope was fitted
FittedParameter kappa_of(const LawEstimate& estimate, const Covariance& covariance);

/// Returns a parameter with its standard error and its 95 % interval by Student's t.
FittedParameter fitted_parameter(const Quantity& quantity, const Covariance& covariance);

/// Returns the 95 % interval of one coordinate of theta from its profile. The profile gives the smallest sum of
/// squares for each fixed value of this coordinate. The interval ends where this sum exceeds the minimum by r
/// (t95 s)^2. Here t95 is the half width of the interval by Student's t, in standard errors; s^2 is the
/// variance of the residuals; r is the variance of the coordinate in `covariance` divided by its variance from
/// the residuals. An end is absent if the data allow any value on that side.
ProfileInterval profile_interval(const LawEstimate& estimate, int coordinate, const Covariance& covariance);

}  // namespace floc
