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
#include "floc/fitting/recompression.h"
#include "floc/fitting/regimes.h"
#include "floc/fitting/residual_pattern.h"
#include "floc/fitting/robust.h"

namespace floc {

/// Weights of the points of a consolidation curve in a fit. They follow from the assumed errors of the inverse solid
/// fraction 1/Phi.
enum class Weighting {
  automatic,  ///< `scatter` if the curve is the mean over three samples or more, otherwise `relative`
  uniform,    ///< equal errors at all points
  relative,   ///< errors in proportion to 1/Phi
  between,    ///< errors in proportion to sqrt(1/Phi), a compromise between `uniform` and `relative`
  scatter,    ///< errors of a mean over several samples, computed from the scatter between these samples
};

struct ConsolidationOptions {
  ConsolidationLaw law = ConsolidationLaw::full;
  /// Lowest and highest reduced pressure P* of the points to fit. If absent, the regimes of the curve are found first:
  /// regime I (a plateau), regime II (a line in ln P*) and regime III (a power law). The full law is then fitted to
  /// regimes II and III, the law `log` to regime II, and the law `power` to regime III.
  std::optional<std::pair<double, double>> window;
  /// Whether P0*, the pressure at which the line of regime II begins, is set to the first pressure fitted. Otherwise
  /// P0* is the pressure at which the line of regime II meets the plateau of regime I.
  bool hold_P0 = false;
  Weighting weighting = Weighting::automatic;
  Loss loss = Loss::squared;
  int n_bootstrap = 0;  ///< number of bootstrap fits; 0 for no bootstrap
  std::uint64_t seed = 1;
  /// Largest solid fraction to which a law may tend at high pressure; infinity for no bound.
  double phi_limit = 1.0;
  /// Regimes of the curve, if they are known. In this case, a recompression line is fitted to the points before regime
  /// II, and its slope kappa is a parameter.
  std::optional<Regimes> regimes = {};
  /// Whether systematic residuals widen the intervals of a fit to a single curve.
  bool widen = false;

  static constexpr WholeRange kBootstrap{.least = 2, .most = 1000000};
  /// Returns the faults of the options, each as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Consolidation curve (solid fraction against pressure) of one sample, or the mean curve of several samples. The
/// points are in the order of growing pressure.
struct ConsolidationCurve {
  /// Reduced pressure P* > 0. In 2D with adhesion, P* = a P/F0, where a is the grain diameter, P the pressure and F0
  /// the pull-off force.
  std::vector<double> P_star;
  std::vector<double> phi;  ///< solid fraction, > 0
  /// For a mean curve, 1/Phi of each sample (one row per pressure, one column per sample); otherwise empty.
  Eigen::MatrixXd samples;
};

/// Value of lambda, the slope of the line of regime II, from a fit with one end of the range of fitted points moved by
/// one point.
struct WindowShift {
  /// End that moves: "first row earlier", "first row later", "last row earlier" or "last row later".
  std::string change;
  /// Value of lambda from this fit; absent if the fit leaves fewer than three points to regime II.
  std::optional<double> lambda;
};

/// Standard error of a parameter of the consolidation law, divided into two parts. The squares of the parts add up to
/// the square of the standard error.
struct ErrorParts {
  std::string name;      ///< name of the parameter
  double scatter = 0.0;  ///< part due to the scatter between samples or, for a single curve, the residuals
  /// Part due to the uncertain ends of the regimes: the scatter between fits with different ends of the regimes.
  double regimes = 0.0;
};

/// Result of the fit of a consolidation law, or the reason why there is no fit.
struct ConsolidationFit {
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  ConsolidationLaw law = ConsolidationLaw::full;
  double window_low = 0.0, window_high = 0.0;  ///< first and last reduced pressure fitted
  std::vector<int> used;                       ///< indices of the points fitted
  std::optional<Regimes> regimes;  ///< regimes of the whole curve; absent if the options give the window
  /// Number of points before the window that form the plateau of regime I.
  int n_plateau = 0;
  /// Last reduced pressure of the plateau of regime I; 0 if there is no plateau.
  double plateau_high = 0.0;
  double plateau_low = 0.0;  ///< first reduced pressure of the plateau; 0 if there is no plateau
  RecompressionLine line;    ///< line through the points of the plateau; level unless line.slopes
  std::vector<FittedParameter> parameters;  ///< parameters of the law, the fitted ones first
  /// Names of the parameters, in the order of the rows of `correlation`.
  std::vector<std::string> correlated;
  Eigen::MatrixXd correlation;  ///< correlation matrix of the fitted parameters
  double rms = 0.0;             ///< root mean square residual of 1/Phi over the points fitted
  /// Law whose parameters are in `theta`: the line of regime II if the points do not show the bend of the full law,
  /// otherwise the law in the options.
  ConsolidationLaw reported_law = ConsolidationLaw::full;
  Eigen::VectorXd theta;    ///< fitted parameters of the law, as LawSolution defines them
  Eigen::VectorXd fitted;   ///< inverse solid fraction 1/Phi of the fitted law at each point fitted
  Eigen::VectorXd weights;  ///< weights with which the points were fitted
  Weighting weighting = Weighting::automatic;  ///< weighting that the fit used
  /// True if the standard errors are from the scatter between samples, false if they are from the residuals of the fit.
  bool errors_from_samples = false;
  /// Parts of the standard errors; parameters without a standard error are left out.
  std::vector<ErrorParts> error_parts;
  /// Names of the parameters whose 95 % interval is from the profile likelihood.
  std::vector<std::string> profiled;
  /// Values of lambda, the slope of regime II, for other windows: in each of them, one end is moved by one point. Ends
  /// beyond the curve are left out.
  std::vector<WindowShift> window_shifts;
  int n_bootstrapped = 0;  ///< number of bootstrap fits that leave at least three points to regime II
  /// Mean, standard deviation and percentiles 2.5 and 97.5 of each parameter over the bootstrap fits.
  std::vector<FittedParameter> bootstrap;
  double phi_limit = 1.0;   ///< largest solid fraction to which the law may tend
  ResidualPattern pattern;  ///< pattern in the residuals of a fit to a single curve
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
  /// Returns 1/Phi, the inverse solid fraction, of the fitted law at the reduced pressure exp(log_P). @pre found()
  double value(double log_P) const;
  /// Returns the parameter with the given name, or null if the law has no such parameter.
  const FittedParameter* find(const std::string& name) const;
};

/// Returns a curve as points with the given weights. For a search for regimes, `weighting` must not be
/// Weighting::scatter, because the deviations of a sample at neighbouring pressures are correlated.
[[nodiscard]] LawPoints law_points(const ConsolidationCurve& curve, Weighting weighting);

/// Fits a consolidation law (docs/physics.md, "Consolidation laws") to a curve of the solid fraction Phi against the
/// reduced pressure P*. The fit is by weighted least squares in 1/Phi or, if the options choose a robust loss function,
/// by the minimum of this function.
///
/// Standard errors of a fit to a single curve follow from the residuals. Standard errors of a fit to a mean over three
/// samples or more follow from the scatter of the samples: the deviation of each sample from the mean is propagated
/// through the linearised fit, which includes the correlation of errors along the curve. If the fit has found the
/// regimes, the scatter of the parameters over the probable ends of the regimes is added. At the beginning of regime
/// II, samples may lag behind the line (Regimes::n_lagging). In this case, the line is fitted without the points with a
/// lag, and the beginning of regime II is not varied.
///
/// The 95 % intervals follow from Student's t in the logarithm of a parameter, or in 1/Phi0 for Phi0. The intervals of
/// alpha and Phi_max follow from the profile likelihood. The bootstrap draws samples if the curve is a mean over
/// samples; otherwise it draws residuals.
///
/// If the data end before P1*, the pressure at which regime III begins, the fit gives only bounds of P1* and Phi_max,
/// and no value of the exponent alpha. There is no fit, but a `failure_reason`, if there are too few points, if all
/// points lie in regime I, or if the solid fraction does not grow with pressure.
/// @pre All pressures and solid fractions are positive and finite, and the pressures grow.
/// @throws InputError with the faults of the options if they are not valid
[[nodiscard]] ConsolidationFit fit_consolidation(const ConsolidationCurve& curve,
                                                 const ConsolidationOptions& options);

}  // namespace floc
