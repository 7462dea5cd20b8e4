// Benchmark of a fit of the consolidation law and its bootstrap, for a curve with 26 pressures:
//   floc_bench --benchmark_filter=consolidation

#include <benchmark/benchmark.h>

#include <cmath>

#include "floc/base/random.h"
#include "floc/fitting/consolidation.h"
#include "floc/fitting/consolidation_law.h"

namespace floc {
namespace {

/// Returns a consolidation curve: a plateau at low pressure, and then the consolidation law. The curve has ten points
/// per decade of pressure, each with a random relative error of 0.3 %.
ConsolidationCurve noisy_curve() {
  const ConsolidationLawParameters law{0.11, 0.9, 0.8, 2.0};
  RandomStream random(2, 0);
  ConsolidationCurve curve;
  for (int k = -15; k <= 10; ++k) {
    curve.P_star.push_back(std::pow(10.0, 0.1 * k));
    curve.phi.push_back((1.0 + 0.003 * random.normal()) / law.inverse_phi(curve.P_star.back()));
  }
  return curve;
}

/// @param state  benchmark; range(0), the argument of the benchmark, is the number of resampled fits
void consolidation(benchmark::State& state) {
  const ConsolidationCurve curve = noisy_curve();
  ConsolidationOptions options;
  options.n_bootstrap = static_cast<int>(state.range(0));
  for (auto _ : state) {
    const ConsolidationFit fit = fit_consolidation(curve, options);
    if (!fit.found()) state.SkipWithError(fit.failure_reason.c_str());
    benchmark::DoNotOptimize(fit);
  }
}
BENCHMARK(consolidation)->ArgName("bootstrap")->Arg(0)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace floc
