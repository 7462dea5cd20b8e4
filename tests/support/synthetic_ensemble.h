#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "floc/base/random.h"
#include "floc/fitting/loading_path.h"
#include "support/synthetic_soil.h"

namespace floc::test {

/// Ensemble of samples that collapse in jumps. All samples follow one curve: a plateau up to P0, then a line of slope
/// lambda. Each sample jumps to this curve at its own random pressures, and keeps its density between the jumps. The
/// distances between successive jumps in ln P are exponentially distributed with the mean `gap`. Each sample is also
/// shifted by a constant.
struct Staircases {
  double lambda = 0.2, P0 = 0.05, y0 = 1.9;
  double gap = 0.2, shift = 0.01, noise = 1e-4;

  ConsolidationCurve sample(RandomStream& random) const {
    const double low = std::log(0.01), high = std::log(14.0);
    std::vector<double> jumps;
    for (double x = low - 3.0 * gap; x < high; x -= gap * std::log(1.0 - random.uniform())) jumps.push_back(x);
    const double own = shift * random.normal();
    ConsolidationCurve curve;
    for (const double P : geometric_pressures(0.01, 13.33, 27)) {
      const double last = *(std::upper_bound(jumps.begin() + 1, jumps.end(), std::log(P)) - 1);
      const double y = y0 - lambda * std::max(last - std::log(P0), 0.0) + own;
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
