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

/// Weights of the points of a curve, by the errors of 1/Phi that are assumed.
enum class Weighting {
  automatic,  ///< `scatter` for a mean of three samples or more, otherwise `relative`
  uniform,    ///< errors that are the same everywhere
  relative,   ///< errors in proportion to 1/Phi, the volume of the sample
  scatter,    ///< errors of the mean over samples, from their scatter
};

struct ConsolidationOptions {
  ConsolidationLaw law = ConsolidationLaw::full;
  /// Reduced pressures to fit on, both included. Absent: the regimes are searched for, and each law is fitted
  /// on its own: the full law from the end of the plateau on, the line on regime II, the power law on regime
  /// III.
  std::optional<std::pair<double, double>> window;
  /// Whether P0* is held at the first pressure fitted, instead of where the plateau meets the line of regime
  /// II.
  bool hold_P0 = false;
  Weighting weighting = Weighting::automatic;
  Loss loss = Loss::squared;
  int n_bootstrap = 0;  ///< resampled fits; 0 for none
  std::uint64_t seed = 1;

  static constexpr WholeRange kBootstrap{.least = 2, .most = 1000000};
  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Points of one sample, or a mean of several, in the order of growing pressure.
struct ConsolidationCurve {
  std::vector<double> P_star;  ///< reduced pressure aP/F0, > 0
  std::vector<double> phi;     ///< solid fraction, > 0
  Eigen::MatrixXd samples;     ///< for a mean: 1/Phi of each sample, pressures x samples; otherwise empty
};

/// Change of lambda when one end of the fitted window moves by one row.
struct WindowShift {
  std::string change;  ///< "first row earlier", "first row later", "last row earlier", "last row later"
  /// lambda of the fit on that window; absent where too little of regime II is left.
  std::optional<double> lambda;
};

/// Parts of the standard error of a parameter.
struct ErrorParts {
  std::string name;      ///< of the parameter
  double scatter = 0.0;  ///< from the scatter between samples, or the residuals (see errors_from_samples)
  double regimes = 0.0;  ///< from the uncertain ends of the regimes: spread over their probable places
};

/// Result of the fit of a consolidation law, or the reason why there is none.
struct ConsolidationFit {
  std::string failure_reason;  ///< empty when there is a fit
  ConsolidationLaw law = ConsolidationLaw::full;
  double window_low = 0.0, window_high = 0.0;  ///< first and last pressure fitted
  std::vector<int> used;                       ///< indices of the points fitted
  std::optional<Regimes> regimes;              ///< regimes of the whole curve; absent with a given window
  int n_plateau = 0;                           ///< points before the window taken as the plateau of regime I
  double plateau_high = 0.0;                   ///< last pressure of the plateau, 0 without one
  std::vector<FittedParameter> parameters;     ///< the free ones first
  std::vector<std::string> correlated;         ///< names of the rows and columns of `correlation`
  Eigen::MatrixXd correlation;                 ///< free parameters x free parameters
  double rms = 0.0;                            ///< root mean square residual of 1/Phi over the points fitted
  /// The law that `theta` belongs to, which the points can identify: the line, where no bend is detected.
  ConsolidationLaw reported_law = ConsolidationLaw::full;
  Eigen::VectorXd theta;                       ///< coordinates of the solution, see `solve_law`
  Eigen::VectorXd fitted;                      ///< 1/Phi by the law at the points fitted
  Eigen::VectorXd weights;                     ///< weights of the points fitted, as used in the solution
  Weighting weighting = Weighting::automatic;  ///< weighting used
  bool errors_from_samples = false;        ///< standard errors from the scatter between samples, not residuals
  std::vector<ErrorParts> error_parts;     ///< one entry per parameter with a standard error
  std::vector<std::string> profiled;       ///< parameters whose interval is that of the profile likelihood
  std::vector<WindowShift> window_shifts;  ///< shifts for which enough rows exist
  int n_bootstrapped = 0;                  ///< resampled fits that kept a regime II
  std::vector<FittedParameter> bootstrap;  ///< mean, deviation and percentiles of the resampled fits
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
  /// Returns 1/Phi by the law. @pre found()
  double value(double log_P) const;
  /// Returns the parameter of that name, or null if the law has none.
  const FittedParameter* find(const std::string& name) const;
};

/// Fits a consolidation law by (weighted, robust) least squares in 1/Phi.
///
/// Standard errors: for a single curve from the covariance at the solution, scaled by the residual variance;
/// for a mean of three samples or more from their scatter, carried through the fit sample by sample, so that
/// errors correlated along the curve are counted. Where regimes were searched for, the spread of the results
/// over their probable places is added. Intervals: Student's t in ln(parameter) or 1/Phi; for alpha and Phi_max
/// the profile likelihood. Bootstrap: resampled samples for a mean (one fewer than there are, which makes the
/// variance unbiased), resampled residuals for a single curve. Where the data stop before P1*, alpha, P1* and
/// Phi_max are given as bounds. There is no fit to too few points, to points of regime I alone, or to a density
/// that does not grow with pressure; `failure_reason` then gives the reason.
/// @pre all pressures and solid fractions are positive and finite, pressures grow.
/// @throws InputError with the faults of the options
[[nodiscard]] ConsolidationFit fit_consolidation(const ConsolidationCurve& curve,
                                                 const ConsolidationOptions& options);

}  // namespace floc
