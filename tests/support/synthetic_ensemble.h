#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "floc/base/infinity.h"
#include "floc/base/random.h"
#include "floc/fitting/consolidation_law.h"
#include "floc/fitting/loading_path.h"
#include "support/synthetic_soil.h"

namespace floc::test {

/// Ensemble of samples that collapse in jumps. All samples follow one curve: a plateau up to P0, then a line of slope
/// lambda or, with a finite P1, the full consolidation law. Each sample jumps to this curve at its own random
/// pressures, and keeps its density between the jumps. The distances between successive jumps in ln P are exponentially
/// distributed with the mean `gap`. Each sample is also shifted by a constant.
struct Staircases {
  double lambda = 0.2, P0 = 0.05, y0 = 1.9;
  double gap = 0.2, shift = 0.01, noise = 1e-4;
  double P1 = kInfinity, alpha = 0.95;

  /// Returns 1/Phi of the common curve at a pressure with the logarithm `log_P`.
  double curve_at(double log_P) const {
    const double beyond = std::max(log_P - std::log(P0), 0.0);
    if (std::isinf(P1)) return y0 - lambda * beyond;
    const double at_P0 = std::log(P0 / P1);
    return y0 - lambda * (consolidation_bracket(at_P0 + beyond, alpha) - consolidation_bracket(at_P0, alpha));
  }

  ConsolidationCurve sample(RandomStream& random) const {
    const double low = std::log(0.01), high = std::log(14.0);
    std::vector<double> jumps;
    for (double x = low - 3.0 * gap; x < high; x -= gap * std::log(1.0 - random.uniform())) jumps.push_back(x);
    const double own = shift * random.normal();
    ConsolidationCurve curve;
    for (const double P : geometric_pressures(0.01, 13.33, 27)) {
      const double last = *(std::upper_bound(jumps.begin() + 1, jumps.end(), std::log(P)) - 1);
      const double y = curve_at(last) + own;
      curve.P_star.push_back(P);
      curve.phi.push_back(1.0 / (y + noise * random.normal()));
    }
    return curve;
  }

  ConsolidationCurve mean_of(int n_samples, RandomStream& random) const {
    std::vector<ConsolidationCurve> samples;
    for (int k = 0; k < n_samples; ++k) samples.push_back(sample(random));
    return mean_curve(samples);
  }
};

}  // namespace floc::test
