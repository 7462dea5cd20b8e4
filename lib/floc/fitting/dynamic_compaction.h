#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"

namespace floc {

/// One sample of the dynamic compaction of a cohesive powder [SVI2024]. The cohesion and the stiffness of its
/// contacts are given as stresses.
struct CompactedSample {
  double e;   ///< void ratio, > 0
  double p;   ///< pressure, > 0
  double sc;  ///< cohesion: pull-off force divided by squared grain diameter, > 0, in the unit of p
  double se;  ///< stiffness: normal stiffness of a contact divided by grain diameter, > 0, in the unit of p
};

/// Pressure at which the plateau of the void ratio is evaluated in the law of dynamic compaction.
enum class PlateauPressure {
  own,  ///< pressure p of the sample
  /// Pressure p_crit = sc^2/se of the sample, at which eta* = sc/sqrt(p se) equals 1, as in the printed law of
  /// [SVI2024].
  critical,
};

/// Reference values of the law of dynamic compaction, which the user chooses. Other reference values do not change the
/// form of the law, but the values of its parameters.
struct CompactionReference {
  /// Pressure, in the unit of p, at which the plateau of the void ratio is e_min + De; 0.01 MPa in [SVI2024].
  double p_D = 0.01;
  /// Reference value by which eta* = sc/sqrt(p se) is divided in the law; 0.045 in [SVI2024]. The parameter s_m is the
  /// value of (1 - e_r)/e_r at eta* = eta_m, where e_r is the relative void ratio.
  double eta_m = 0.045;
  /// Lower limit of the pressure at which the plateau is evaluated; samples below this limit are not fitted. The value
  /// 0 means no limit for PlateauPressure::own, and the limit p_D for PlateauPressure::critical, because the published
  /// plateau has a pole not far below p_D.
  double p_0 = 0.0;
  PlateauPressure plateau = PlateauPressure::own;

  /// Returns the faults of the reference values, each as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Returns the void ratio e by the law of dynamic compaction ([SVI2024], Eqs 13-17, 29-31), for any scalar type T:
///
///   e = e_min + e_r De/(1 + C De ln(p/p_D))
///   e_r = S/(1 + S),   S = A x^a + (1/s_m - A) x^b,   x = eta*/eta_m,   eta* = sc/sqrt(p se)
///
/// @param theta           the seven numbers e_min, ln De, C, ln A, ln(1/s_m - A), ln a and ln(b - a)
/// @param log_p_over_p_D  ln(p/p_D), with p the pressure at which the plateau is evaluated (PlateauPressure)
/// @param log_x           ln x, with eta* at the pressure p of the sample
template <class T>
T compacted_void_ratio(const T* theta, double log_p_over_p_D, double log_x) {
  using std::exp;
  const T De = exp(theta[1]);
  const T a = exp(theta[5]);
  const T b = a + exp(theta[6]);
  const T S = exp(theta[3] + a * log_x) + exp(theta[4] + b * log_x);
  return theta[0] + De / (1.0 + theta[2] * De * log_p_over_p_D) * S / (1.0 + S);
}

/// Standard error of a parameter in the law of dynamic compaction, divided into parts. The squares of the parts add up
/// to the square of the standard error.
struct CompactionErrorParts {
  std::string name;  ///< name of the parameter
  /// Part due to the scatter between repeated runs or, if no run is repeated, due to the residuals.
  double scatter = 0.0;
  /// Part due to the amount by which the residuals exceed the scatter between repeated runs; 0 if no run is repeated.
  double law = 0.0;
  /// Part due to the choice of the samples that are left out because they do not lie on the plateau of the law.
  double plateau = 0.0;
};

/// Law of dynamic compaction fitted to samples, or the reason why there is no fit.
struct CompactionFit {
  std::string failure_reason;               ///< reason why there is no fit; empty if there is one
  std::vector<FittedParameter> parameters;  ///< parameters e_min, De, C, A, s_m, a, b of the law
  /// Correlation matrix of the parameters, in the order of `parameters`.
  Eigen::MatrixXd correlation;
  std::vector<int> used;  ///< indices of the samples fitted
  /// Indices of samples left out because their plateau is evaluated at a pressure below p_0.
  std::vector<int> below_p_0;
  /// Indices of samples left out because they do not lie on the plateau of the law.
  std::vector<int> beside_plateau;
  double rms = 0.0;  ///< root mean square residual of the void ratio e
  /// True if CompactionErrorParts::scatter is from repeated runs (equal p, sc and se), false if it is from the
  /// residuals.
  bool errors_from_runs = false;
  /// Parts of the standard errors; parameters without a standard error are left out.
  std::vector<CompactionErrorParts> error_parts;
  /// Names of the parameters whose 95 % interval is from the profile likelihood.
  std::vector<std::string> profiled;
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits the law of dynamic compaction by least squares in the void ratio e, from starting points on a grid.
///
/// Samples that do not lie on the plateau are flagged and not fitted. A sample is flagged if it lies above the plateau
/// or has eta* > 1, and if its distance from a robust fit to all samples is more than four standard deviations.
///
/// Standard errors have two parts: one follows from the residuals, the other is the change of the parameters if samples
/// are flagged at a distance of 2.5 or 6 standard deviations instead of four. The 95 % intervals of A and a follow from
/// the profile likelihood. All other intervals follow from Student's t, in the coordinates e_min, 1/De, C, ln s_m and
/// ln b.
///
/// With fewer than eight samples, there is no fit, but a `failure_reason`. A parameter that the samples do not identify
/// has no value, and is named in a warning.
/// @throws InputError with the faults of the reference values if they are not valid
[[nodiscard]] CompactionFit fit_dynamic_compaction(const std::vector<CompactedSample>& samples,
                                                   const CompactionReference& reference);

}  // namespace floc
