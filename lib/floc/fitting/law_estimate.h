#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/fitting/consolidation_solver.h"
#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/profile_likelihood.h"
#include "floc/fitting/recompression.h"

namespace floc {

/// A consolidation law fitted to a range of points. The coordinates of the fit are the entries of theta (LawSolution).
/// If a line is fitted to points before regime II, there are two more coordinates: the level of this line and, if
/// fitted, its slope kappa. The parameters of the law are functions of the coordinates.
struct LawEstimate {
  ConsolidationLaw law;
  LawPoints points;
  LawSolution solution;
  LawPoints plateau;       ///< points of the plateau or recompression line before regime II; may be empty
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
  /// Whether the parameter of the mean curve equals the mean of the parameters of the samples, as for the slope of a
  /// line.
  bool is_mean = false;

  double parameter() const;
};

/// Returns the parameters of a fitted consolidation law. The first parameters correspond to the entries of theta.
/// Without a plateau, P0*, the pressure at which the line of regime II begins, is left out, because it is given and not
/// fitted.
std::vector<Quantity> quantities_of(const LawEstimate& estimate);

/// Covariance of the coordinates of a fit, with its number of degrees of freedom.
struct Covariance {
  Eigen::MatrixXd matrix;
  int dof;
  bool is_of_samples = false;  ///< whether the covariance was computed from the scatter between samples
};

/// Returns the covariance of the coordinates: (J^T J)^-1 times the residual variance, where J is the Jacobian of the
/// weighted residuals.
Covariance covariance_from_residuals(const LawEstimate& estimate);

/// Returns the covariance of the coordinates if the law was fitted to a mean of samples. The covariance follows from
/// the changes of the coordinates that the deviation of each sample from the mean causes in the linearised fit.
/// @param deviations  deviation of 1/Phi of each sample from the mean over samples. Rows: the points of the plateau,
/// then the other points fitted; columns: two samples or more
Covariance covariance_from_samples(const LawEstimate& estimate, const Eigen::MatrixXd& deviations);

/// Returns the slope kappa of the recompression line with its 95 % interval; negative numbers are raised to 0. @pre the
/// slope was fitted
FittedParameter kappa_of(const LawEstimate& estimate, const Covariance& covariance);

/// Returns a parameter with its standard error and its 95 % interval by Student's t.
FittedParameter fitted_parameter(const Quantity& quantity, const Covariance& covariance);

/// Returns the 95 % interval of one coordinate of theta from its profile, which is the smallest sum of squares for each
/// fixed value of this coordinate. The interval ends where the profile exceeds its minimum by r (t95 s)^2. Here t95 is
/// the half width of Student's interval in standard errors, s^2 the variance of the residuals, and r the variance of
/// the coordinate in `covariance` divided by its variance from the residuals. An end is absent if the data allow any
/// value on that side.
ProfileInterval profile_interval(const LawEstimate& estimate, int coordinate, const Covariance& covariance);

}  // namespace floc
