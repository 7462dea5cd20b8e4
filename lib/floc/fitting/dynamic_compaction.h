#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// One compacted sample [SVI2024]: void ratio, pressure, and the cohesion and stiffness of its contacts as
/// stresses.
struct CompactedSample {
  double e;   ///< void ratio, > 0
  double p;   ///< pressure, > 0
  double sc;  ///< f_c/d^2, > 0, unit of p
  double se;  ///< k_n/d, > 0, unit of p
};

/// The pressure at which the plateau of a sample is taken.
enum class PlateauPressure {
  own,       ///< p of the sample
  critical,  ///< p_crit = sc^2/se, which is p where eta* = 1: as the law is printed
};

/// Reference values of the law. They are chosen, not fitted, because the law keeps its form for any values of
/// them.
struct CompactionReference {
  double p_D = 0.01;     ///< pressure at which the plateau is e_min + De, unit of p; 0.01 MPa in [SVI2024]
  double eta_m = 0.045;  ///< eta* at which (1 - e_r)/e_r = s_m; that of [SVI2024]
  /// Smallest pressure of the plateau of the samples fitted. If it is not positive, there is no limit for
  /// `own`, and for `critical` the limit is p_D, not far below which the published plateau has a pole.
  double p_0 = 0.0;
  PlateauPressure plateau = PlateauPressure::own;

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// The law of dynamic compaction ([SVI2024], Eqs 13-17, 29-31) on any scalar:
///
///   e = e_min + e_r De/(1 + C De ln(p/p_D))
///   e_r = S/(1 + S),   S = A x^a + (1/s_m - A) x^b,   x = eta*/eta_m,   eta* = sc/sqrt(p se)
///
/// @param theta  e_min, ln De, C, ln A, ln(1/s_m - A), ln a, ln(b - a)
template <class T>
T compacted_void_ratio(const T* theta, double log_p_over_p_D, double log_x) {
  using std::exp;
  const T De = exp(theta[1]);
  const T a = exp(theta[5]);
  const T b = a + exp(theta[6]);
  const T S = exp(theta[3] + a * log_x) + exp(theta[4] + b * log_x);
  return theta[0] + De / (1.0 + theta[2] * De * log_p_over_p_D) * S / (1.0 + S);
}

/// Parts of the standard error of a parameter.
struct CompactionErrorParts {
  std::string name;      ///< of the parameter
  double scatter = 0.0;  ///< between repeated runs or, without any, of the residuals
  double law = 0.0;      ///< misfit of the law beyond the scatter of repeated runs; 0 without such runs
  double plateau = 0.0;  ///< from the choice of the samples that count as beside the plateau
};

/// Result of a fit of the law, or the reason why there is none.
struct CompactionFit {
  std::string failure_reason;               ///< empty when there is a fit
  std::vector<FittedParameter> parameters;  ///< e_min, De, C, A, s_m, a, b
  Eigen::MatrixXd correlation;              ///< in their order
  std::vector<int> used;                    ///< indices of the samples fitted
  std::vector<int> below_p_0;               ///< indices of samples left out for the pressure of their plateau
  std::vector<int> beside_plateau;          ///< indices of samples flagged as beside the plateau
  double rms = 0.0;                         ///< root mean square residual of e
  bool errors_from_runs = false;  ///< the scatter is that between runs of the same p, sc and se, not residuals
  std::vector<CompactionErrorParts> error_parts;  ///< one entry per parameter with a standard error
  std::vector<std::string> profiled;  ///< parameters whose interval is that of the profile likelihood
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the law by least squares in e, from starts computed on a grid.
///
/// Samples beside the plateau are flagged and not fitted: those above it, or off the law at eta* > 1, where it
/// is all plateau, by more than four deviations of the residuals, measured by a robust fit of all. Standard
/// errors: from the covariance at the solution, scaled by the residual variance, and from the change of the
/// parameters when samples count as beside the plateau at 2.5 or at 6 deviations. Intervals: Student's t in
/// e_min, 1/De, C and the logarithms of the others; for A and a the profile likelihood. There is no fit with
/// fewer than eight samples (see `failure_reason`); parameters that the samples do not identify are named and
/// have no value.
/// @throws InputError with the faults of the reference
[[nodiscard]] CompactionFit fit_dynamic_compaction(const std::vector<CompactedSample>& samples,
                                                   const CompactionReference& reference);

}  // namespace floc
