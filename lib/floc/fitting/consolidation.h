#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/base/range.h"
#include "floc/fitting/consolidation_solver.h"
#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/regimes.h"
#include "floc/fitting/robust.h"

namespace floc {

/// Weights of the points of a consolidation curve, named after the errors that 1/Phi (Phi is the solid
/// fraction) is assumed to have.
enum class Weighting {
  automatic,  ///< `scatter` for a mean of three samples or more, otherwise `relative`
  uniform,    ///< equal errors at all points
  relative,   ///< errors in proportion to 1/Phi, the volume of the sample per volume of its grains
  scatter,    ///< errors of the mean over several samples, from the scatter between the samples
};

struct ConsolidationOptions {
  ConsolidationLaw law = ConsolidationLaw::full;
  /// Lowest and highest reduced pressure of the points fitted. If absent, the regimes are searched for: the
  /// full law is then fitted from the end of the plateau on, the line to regime II, the power law to regime
  /// III.
  std::optional<std::pair<double, double>> window;
  /// Whether P0* is set to the first pressure fitted. Otherwise it is the pressure at which the plateau of
  /// regime I meets the line of regime II.
  bool hold_P0 = false;
  Weighting weighting = Weighting::automatic;
  Loss loss = Loss::squared;
  int n_bootstrap = 0;  ///< number of bootstrap fits; 0 for no bootstrap
  std::uint64_t seed = 1;

  static constexpr WholeRange kBootstrap{.least = 2, .most = 1000000};
  /// Returns the faults of the options, each as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Consolidation curve of one sample, or mean curve of several samples: points in the order of growing
/// pressure.
struct ConsolidationCurve {
  std::vector<double> P_star;  ///< reduced pressure aP/F0, > 0
  std::vector<double> phi;     ///< solid fraction, > 0
  Eigen::MatrixXd samples;  ///< for a mean curve, 1/Phi of each sample (pressures x samples); otherwise empty
};

/// Value of lambda if one end of the fitted window of points moves by one row of the table.
struct WindowShift {
  std::string
      change;  ///< end that moves: "first row earlier", "first row later", "last row earlier" or "last row later"
  /// Value of lambda from the fit on the changed window; absent if fewer than three points of regime II are
  /// left.
  std::optional<double> lambda;
};

/// Parts of the standard error of a parameter of the consolidation law.
struct ErrorParts {
  std::string name;      ///< name of the parameter
  double scatter = 0.0;  ///< part from the scatter between samples or from the residuals
  /// Part from the uncertain ends of the regimes: spread of the parameter over their probable places.
  double regimes = 0.0;
};

/// Result of the fit of a consolidation law, or the reason why there is none.
struct ConsolidationFit {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  ConsolidationLaw law = ConsolidationLaw::full;
  double window_low = 0.0, window_high = 0.0;  ///< first and last reduced pressure fitted
  std::vector<int> used;                       ///< indices of the points fitted
  std::optional<Regimes> regimes;              ///< regimes of the whole curve; absent if the window was given
  /// Number of points before the window that form the plateau of regime I.
  int n_plateau = 0;
  /// Last reduced pressure of the plateau of regime I; 0 if there is no plateau.
  double plateau_high = 0.0;
  std::vector<FittedParameter> parameters;  ///< parameters of the law, the fitted ones first
  std::vector<std::string> correlated;      ///< names of the rows and columns of `correlation`
  Eigen::MatrixXd correlation;              ///< correlation of the fitted parameters
  double rms = 0.0;                         ///< root mean square residual of 1/Phi over the points fitted
  /// Law whose coordinates `theta` are: the line if the points show no bend of the full law, otherwise `law`.
  ConsolidationLaw reported_law = ConsolidationLaw::full;
  Eigen::VectorXd theta;                       ///< coordinates of the solution, see LawSolution
  Eigen::VectorXd fitted;                      ///< values of 1/Phi by the fitted law at the points fitted
  Eigen::VectorXd weights;                     ///< weights of the points fitted, as used in the solution
  Weighting weighting = Weighting::automatic;  ///< weighting used
  /// True if the standard errors are from the scatter between samples, false if from residuals.
  bool errors_from_samples = false;
  std::vector<ErrorParts> error_parts;  ///< parts of the standard error of each parameter that has one
  std::vector<std::string> profiled;    ///< parameters whose interval is from the profile likelihood
  /// Values of lambda on shifted windows, if the table has enough rows.
  std::vector<WindowShift> window_shifts;
  int n_bootstrapped = 0;  ///< number of bootstrap fits that have a regime II
  /// Mean, standard deviation and percentiles 2.5 and 97.5 of the bootstrap fits.
  std::vector<FittedParameter> bootstrap;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
  /// Returns the value of 1/Phi by the fitted law at ln P* = `log_P`. @pre found()
  double value(double log_P) const;
  /// Returns the parameter with the given name, or null if the law has no such parameter.
  const FittedParameter* find(const std::string& name) const;
};

/// Fits a consolidation law to a curve of the solid fraction Phi against the reduced pressure P*, by weighted
/// and, if requested, robust least squares in 1/Phi.
///
/// Standard errors: for a single curve from the covariance at the solution, scaled by the residual variance;
/// for a mean of three samples or more from the scatter of the samples, carried through the linearised fit
/// sample by sample, so that the correlation of errors along the curve is taken into account. If the regimes
/// were searched for, the spread of the parameters over the probable ends of the regimes is added. Intervals:
/// from Student's t in ln(parameter) or 1/Phi; for alpha and Phi_max from the profile likelihood. Bootstrap:
/// for a mean, samples are drawn (one fewer than there are, which makes the variance unbiased); for a single
/// curve, residuals are drawn. If the data end before P1*, the pressure at which regime III begins, the fit
/// gives bounds of P1* and Phi_max and no value of alpha. There is no fit to too few points, to points of
/// regime I alone, or to a solid fraction that does not grow with pressure; `failure_reason` then gives the
/// reason.
/// @pre All pressures and solid fractions are positive and finite, and the pressures grow.
/// @throws InputError with the faults of the options if they are not valid
[[nodiscard]] ConsolidationFit fit_consolidation(const ConsolidationCurve& curve,
                                                 const ConsolidationOptions& options);

}  // namespace floc
