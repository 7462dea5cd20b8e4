#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace floc {

/// Which consolidation law is fitted (PHYSICS section 2; all in 1/Phi, unweighted).
enum class ConsolidationLaw {
  log,    ///< regime II: 1/Phi = 1/Phi0 - lambda ln(P*/P0*)
  power,  ///< regime III: 1/Phi = 1/Phi_max + A (P*)^-alpha
  full,   ///< both: G08 Eq. 9
};

struct ConsolidationOptions {
  ConsolidationLaw law = ConsolidationLaw::full;
  /// Reduced pressures to fit on, both included. Absent: the end of the plateau of regime I is searched for,
  /// and the laws of a single regime stop where a fit of the full law says that it ends.
  std::optional<std::pair<double, double>> window;
  /// P0* is the first pressure fitted, held, rather than where the plateau meets the line of regime II.
  bool hold_P0 = false;
};

/// Points of one sample (or a mean of several) in the order of growing pressure.
struct ConsolidationCurve {
  std::vector<double> P_star;  ///< reduced pressure aP/F0, > 0
  std::vector<double> phi;     ///< solid fraction, > 0
};

/// One parameter. Intervals are symmetric in ln(parameter), for solid fractions in 1/Phi, so that none leaves
/// its range.
struct FittedParameter {
  std::string name;
  std::optional<double> value;           ///< absent when the data bound it only
  std::optional<double> standard_error;  ///< absent for a held parameter
  std::optional<double> low95, high95;   ///< 95 % interval by Student's t; a bound where there is no value
  bool identified = true;                ///< known to within a factor ten either way
};

/// What a fit found, or why there is none.
struct ConsolidationFit {
  std::string refusal;  ///< empty when there is a fit
  ConsolidationLaw law = ConsolidationLaw::full;
  double window_low = 0.0, window_high = 0.0;  ///< first and last pressure fitted
  std::vector<int> used;                       ///< indices of the points fitted
  int n_plateau = 0;                           ///< points before the window taken as the plateau of regime I
  double plateau_high = 0.0;                   ///< last pressure of the plateau, 0 without one
  std::vector<FittedParameter> parameters;     ///< the free ones first
  std::vector<std::string> correlated;         ///< names of the rows and columns of `correlation`
  Eigen::MatrixXd correlation;                 ///< free parameters x free parameters
  double rms = 0.0;                            ///< root mean square residual of 1/Phi over the points fitted
  std::vector<std::string> warnings;

  bool found() const { return refusal.empty(); }
  /// The parameter of that name, null if the law has none.
  const FittedParameter* find(const std::string& name) const;
};

/// Fits a consolidation law by least squares in 1/Phi: starts by linear projection on a grid of the nonlinear
/// parameters, the best few refined by Levenberg-Marquardt (Ceres). Errors from the covariance at the solution,
/// scaled by the residual variance. Where the data stop before P1*, alpha, P1* and Phi_max are given as bounds.
/// Too few points, or a density that does not grow with pressure, is refused in words.
/// @pre all pressures and solid fractions are positive and finite, pressures grow.
[[nodiscard]] ConsolidationFit fit_consolidation(const ConsolidationCurve& curve,
                                                 const ConsolidationOptions& options);

/// One row of a path table.
struct PathRow {
  std::string branch;
  double P_star;
  double phi;
};

/// The first loading of a path: rows of the assembly and the first unbroken run of rows of branch "load". A
/// table without that branch gives its rows up to the first fall of pressure. Rows at P* = 0 are left out and
/// counted.
struct FirstLoading {
  ConsolidationCurve curve;
  std::vector<int> rows;  ///< index of the row of each point
  int n_zero_pressure = 0;
};
FirstLoading first_loading(const std::vector<PathRow>& rows);

/// Mean of 1/Phi over samples at each pressure that all of them have (to 0.1 %); empty if there is none.
ConsolidationCurve pooled_curve(const std::vector<ConsolidationCurve>& samples);

}  // namespace floc
