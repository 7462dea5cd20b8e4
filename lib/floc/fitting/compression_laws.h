#pragma once

#include <span>
#include <string>
#include <vector>

#include "floc/fitting/fitted_parameter.h"
#include "floc/fitting/residual_pattern.h"

namespace floc {

/// Laws of the compression of powders: the solid fraction D (relative density) at the pressure P. D0 is the solid
/// fraction without pressure, and C = 1 - D0/D is the relative reduction of volume.
enum class CompressionLaw {
  heckel,        ///< ln[1/(1 - D)] = A + P/P_y, fitted to the linear part of the curve [Heckel1961]
  kawakita,      ///< C = a b P/(1 + b P) [KL1971]
  cooper_eaton,  ///< C/(1 - D0) = a1 exp(-k1/P) + a2 exp(-k2/P) [CE1962]
  walker,        ///< 1/D = c - L ln P, by Walker and Balshin: the line of regime II [Walker1923]
  gurnham,       ///< D = c + g ln P, by Gurnham and Masson [GM1946]
  adams,         ///< P = (tau/alpha) [exp(alpha e) - 1] with the strain e = ln(D/D0) [AMS1994]
};

/// A compression law, and its name in commands and tables.
struct NamedCompressionLaw {
  CompressionLaw law;
  const char* name;
};
/// Returns all compression laws.
std::span<const NamedCompressionLaw> compression_laws();

struct CompressionOptions {
  /// Solid fraction D0 without pressure. If 0, D0 is a fitted parameter of the laws that contain it.
  double D0 = 0.0;
  /// Largest solid fraction to which a law may tend. Infinity allows values above 1. Such values are measured in a die
  /// under load, because the solid itself is compressed elastically.
  double phi_limit = 1.0;
};

/// Fit of a compression law, or the reason why there is no fit.
struct CompressionFit {
  CompressionLaw law;
  std::string failure_reason;  ///< reason why there is no fit; empty if there is one
  /// Parameters with their intervals. Heckel: P_y, A; Kawakita: a, b, D0, Phi_max; Cooper and Eaton: a1, k1, a2, k2, D0;
  /// Walker and Gurnham: slope and D_1, the solid fraction at the pressure 1; Adams: tau, alpha, D0.
  std::vector<FittedParameter> parameters;
  int first = 0;            ///< index of the first point in the part of the curve to which the law is fitted
  int n_points = 0;         ///< number of points in this part
  double rms = 0.0;         ///< root mean square residual of D over the points of this part
  ResidualPattern pattern;  ///< pattern in the residuals of the law fitted to all points
  /// Corrected Akaike information criterion of the law fitted to all points, up to a constant that depends only on the
  /// data; and this criterion minus its smallest value among the laws fitted together.
  double aicc = 0.0, delta_aicc = 0.0;
  double weight = 0.0;  ///< Akaike weight among the laws fitted together
  std::vector<std::string> warnings;

  bool found() const { return failure_reason.empty(); }
};

/// Fits compression laws to the same points by least squares in D, and ranks the laws by their Akaike information
/// criterion. The weights assume errors of D in proportion to sqrt(D), a compromise between equal and relative errors.
/// Intervals follow from Student's t; the interval of a positive parameter is computed in the logarithm of the
/// parameter. Standard errors are computed from the residual of each single point [MW1985], so that they are valid both
/// for equal and for relative errors of D.
///
/// Heckel's law is fitted to the longest part of the curve in which ln[1/(1 - D)] is a straight function of P: a fitted
/// quadratic term is not significant, or changes the slope by less than a tenth from end to end. For the rank, however,
/// Heckel's law is fitted to all points, like the other laws.
/// @param P  pressures, > 0, growing   @param D  solid fractions, > 0, one per pressure
[[nodiscard]] std::vector<CompressionFit> fit_compression(const std::vector<double>& P,
                                                          const std::vector<double>& D,
                                                          std::span<const CompressionLaw> laws,
                                                          const CompressionOptions& options);

}  // namespace floc
