#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "floc/base/random.h"
#include "floc/fitting/consolidation.h"
#include "floc/fitting/consolidation_law.h"
#include "floc/fitting/loading_path.h"
#include "support/published_consolidation.h"

namespace floc::test {

/// Clay whose 1/Phi decreases by kappa per unit of ln P below the yield pressure, and by lambda per unit above it.
struct TwoLineClay {
  double kappa = 0.03, lambda = 0.2, P_yield = 95.0, y_yield = 1.9;

  double inverse_phi(double P) const {
    const double x = std::log(P / P_yield);
    return y_yield - (x < 0.0 ? kappa : lambda) * x;
  }
};

/// Kind and size of the errors of a curve.
struct Noise {
  enum Kind { of_inverse, of_fraction, relative } kind;
  double size;

  double spoil(double phi, RandomStream& random) const {
    const double error = size * random.normal();
    if (kind == of_inverse) return 1.0 / (1.0 / phi + error);
    return kind == of_fraction ? phi + error : phi * (1.0 + error);
  }
};

/// Returns `n` pressures from low to high. The ratio of successive pressures is constant.
inline std::vector<double> geometric_pressures(double low, double high, int n) {
  std::vector<double> P;
  for (int i = 0; i < n; ++i) P.push_back(low * std::pow(high / low, i / (n - 1.0)));
  return P;
}

/// Returns the solid fractions of a law at given pressures, with random errors.
inline ConsolidationCurve noisy_curve(const std::function<double(double)>& phi_of,
                                      const std::vector<double>& pressures, const Noise& noise,
                                      RandomStream& random) {
  ConsolidationCurve curve;
  for (const double P : pressures) {
    curve.P_star.push_back(P);
    curve.phi.push_back(noise.spoil(phi_of(P), random));
  }
  return curve;
}

/// Returns a curve as it is read from the table of a sample that creeps. At every second pressure, the table has one or
/// two additional rows in which the sample is still looser. Only the last row at each pressure counts.
inline ConsolidationCurve through_creep(const ConsolidationCurve& curve, RandomStream& random) {
  std::vector<PathRow> rows;
  for (std::size_t i = 0; i < curve.phi.size(); ++i) {
    const int n_earlier = i % 2 == 0 ? 0 : 1 + static_cast<int>(random.below(2));
    for (int k = n_earlier; k > 0; --k)
      rows.push_back({"", curve.P_star[i], 1.0 / (1.0 / curve.phi[i] + 0.01 * k * random.uniform())});
    rows.push_back({"", curve.P_star[i], curve.phi[i]});
  }
  return first_loading(rows).curve;
}

}  // namespace floc::test
