#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "floc/base/random.h"
#include "floc/fitting/consolidation.h"
#include "floc/fitting/consolidation_law.h"

namespace floc::test {

/// Returns the pressures of the published path, from `low` up to 13.3. Each pressure is 10^(1/8) times the previous
/// one.
inline std::vector<double> published_pressures(double low) {
  std::vector<double> P;
  for (int k = 0; k <= 25; ++k)
    if (const double p = 0.01 * std::pow(10.0, k / 8.0); p > 0.999 * low) P.push_back(p);
  return P;
}

/// Returns the exact curve of the law at given pressures.
inline ConsolidationCurve curve_of(const ConsolidationLawParameters& law,
                                   const std::vector<double>& pressures) {
  ConsolidationCurve curve;
  for (const double P : pressures) {
    curve.P_star.push_back(P);
    curve.phi.push_back(1 / law.inverse_phi(P));
  }
  return curve;
}

/// Published fit [GRC2008]: lambda, Phi_max, alpha, P0* and Phi0. P1* is determined by the condition that the plateau
/// and the law meet at P0*.
struct Published {
  double lambda, phi_max, alpha, P0_star, phi0;

  ConsolidationLawParameters law() const {
    return {lambda, alpha, phi_max, P0_star * std::exp((1 / phi0 - 1 / phi_max) / lambda)};
  }

  /// Returns the curve of the published path: a constant solid fraction up to P0*, and the law above.
  ConsolidationCurve with_plateau() const {
    ConsolidationCurve curve;
    for (const double P : published_pressures(0.01)) {
      curve.P_star.push_back(P);
      curve.phi.push_back(1 / law().inverse_phi(std::max(P, P0_star)));
    }
    return curve;
  }
};
inline constexpr Published kNoRolling{0.349, 0.7808, 0.91, 0.0237, 0.469};
inline constexpr Published kSmallRolling{0.194, 0.7745, 1.08, 0.0316, 0.515};

/// Returns the curve with normally distributed relative errors of 1/Phi.
/// @param noise  relative standard deviation
inline ConsolidationCurve with_relative_noise(ConsolidationCurve curve, double noise, RandomStream& random) {
  for (double& phi : curve.phi) phi = 1 / (1 / phi * (1 + noise * random.normal()));
  return curve;
}

}  // namespace floc::test
