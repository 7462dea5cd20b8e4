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

/// Reference values of the law: they are chosen, not fitted, because the law has the same form for any of them.
struct CompactionReference {
  double p_D = 0.01;     ///< pressure at which the plateau is e_min + De, unit of p; 0.01 MPa in [SVI2024]
  double eta_m = 0.045;  ///< eta* at which (1 - e_r)/e_r = s_m; that of [SVI2024]
  /// Smallest p_crit = sc^2/se fitted: the plateau has a pole below p_D; p_D if not positive.
  double p_0 = 0.0;
};

/// The law of dynamic compaction ([SVI2024], Eqs 13-17, 29-31) on any scalar:
///
///   e = e_min + e_r De / (1 + C De ln(p_crit/p_D)),   p_crit = sc^2/se
///   e_r = S/(1 + S),   S = A x^a + (1/s_m - A) x^b,   x = eta*/eta_m,   eta* = sc/sqrt(p se)
///
/// @param theta  e_min, ln De, C, ln A, ln(1/s_m - A), ln a, ln(b - a)
template <class T>
T compacted_void_ratio(const T* theta, double log_p_crit_over_p_D, double log_x) {
  using std::exp;
  const T De = exp(theta[1]);
  const T a = exp(theta[5]);
  const T b = a + exp(theta[6]);
  const T S = exp(theta[3] + a * log_x) + exp(theta[4] + b * log_x);
  return theta[0] + De / (1.0 + theta[2] * De * log_p_crit_over_p_D) * S / (1.0 + S);
}

/// What a fit of the law found, or why there is none.
struct CompactionFit {
  std::string refusal;                      ///< empty when there is a fit
  std::vector<FittedParameter> parameters;  ///< e_min, De, C, A, s_m, a, b
  Eigen::MatrixXd correlation;              ///< in their order
  std::vector<int> used;                    ///< indices of the samples fitted
  double rms = 0.0;                         ///< root mean square residual of e
  std::vector<std::string> warnings;

  bool found() const { return refusal.empty(); }
};

/// Least squares in e from starts computed on a grid. Samples with p_crit < p_0 are left out. Refused with
/// fewer than eight samples; parameters that the samples do not identify (De and C, where p_crit hardly varies)
/// are said.
[[nodiscard]] CompactionFit fit_dynamic_compaction(const std::vector<CompactedSample>& samples,
                                                   const CompactionReference& reference);

}  // namespace floc
