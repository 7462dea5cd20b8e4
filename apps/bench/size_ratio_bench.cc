// Contact updates per second of the time stepping, new lists of pairs among it, for grains of sizes 1:2 and
// 1:30, under P/K_N = 1e-4 with friction. Diameters are uniform, as scenes draw them, or uniform by area, P(d)
// ~ d^-2 (Voivret et al., Phys. Rev. Lett. 102, 178001), of which most are small and touch nothing. Compare the
// rows of one run and distribution. FLOC_BENCH_RATIO=100 adds a ratio.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <map>
#include <numeric>
#include <tuple>

#include "floc/assembly/gas.h"
#include "floc/packing/balance.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/relaxer.h"

namespace floc {
namespace {

constexpr int kGrains = 5000;
constexpr double kPressure = 10.0;  ///< of K_N = 1e5, a = m = 1

enum Load {
  kIsotropic,  ///< the packing comes to rest
  kBiaxial,    ///< and flows: one axis under half the pressure, the other under half as much again
};

enum Sizes {
  kUniform,        ///< P(d) constant
  kUniformByArea,  ///< P(d) ~ d^-2
};

/// n diameters in [1/ratio, 1], equally spaced quantiles of their distribution.
std::vector<double> diameters(int n, double ratio, Sizes sizes) {
  std::vector<double> diameter(n);
  for (int i = 0; i < n; ++i) {
    const double share = static_cast<double>(i) / (n - 1);
    diameter[i] = sizes == kUniform ? 1.0 - (1.0 - 1.0 / ratio) * share : 1.0 / (1.0 + (ratio - 1.0) * share);
  }
  return diameter;
}

BoundaryControl<2> loaded(const Packing<2>& packing, const Vec<2>& stress) {
  RelaxationOptions options;
  options.inertial_number_cap = 0.03;
  const double mass = 0.01 * std::accumulate(packing.grains.mass.begin(), packing.grains.mass.end(), 0.0);
  return BoundaryControl<2>::normal_stress(stress, mass, strain_rate_cap(options, packing, stress));
}

Packing<2> moved_for(const Packing<2>& packing, const Vec<2>& stress, double time, DynamicsSettings& settings) {
  Packing<2> now = packing;
  for (double t = 0.0; t < time; t += kStepsPerChunk * settings.time_step) {
    const auto dynamics = make_dynamics(now, loaded(now, stress), settings);
    dynamics->advance(kStepsPerChunk, Motion::free);
    settings.skin = dynamics->skin();
    now = dynamics->packing();
  }
  return now;
}

DynamicsSettings settings_of(const Packing<2>& packing) {
  return {time_step_of(packing, RelaxationOptions().time_step), 0.01};
}

/// A gas compressed for half as long again as it takes to be dense, then loaded; each is made once.
const Packing<2>& dense(double ratio, Sizes sizes, Load load) {
  static std::map<std::tuple<double, Sizes, Load>, Packing<2>> made;
  const auto [entry, is_new] = made.try_emplace({ratio, sizes, load});
  Packing<2>& packing = entry->second;
  if (!is_new) return packing;
  if (load == kBiaxial) {
    const Packing<2>& rest = dense(ratio, sizes, kIsotropic);
    DynamicsSettings settings = settings_of(rest);
    return packing = moved_for(rest, kPressure * Vec<2>(0.5, 1.5), 1.0, settings);
  }
  GrainOptions grains;
  grains.count = kGrains;
  grains.diameter.kind = DiameterDistribution::Kind::list;
  grains.diameter.values = diameters(kGrains, ratio, sizes);
  LawParameters law;
  law.normal = LinearRepulsion{1e5};
  law.damping = ViscousDamping{0.015, DampingMass::effective};
  law.friction = CoulombFriction{0.5, 1e5};
  RandomStream random(1, 1);
  const Packing<2> gas = make_gas<2>(grains, law, 0.4, random);
  DynamicsSettings settings = settings_of(gas);
  return packing = moved_for(gas, Vec<2>::Constant(kPressure), 6.0, settings);
}

void size_ratio(benchmark::State& state) {
  const auto sizes = static_cast<Sizes>(state.range(1));
  const auto load = static_cast<Load>(state.range(2));
  const Packing<2>& start = dense(static_cast<double>(state.range(0)), sizes, load);
  const Vec<2> stress = load == kBiaxial ? Vec<2>(kPressure * Vec<2>(0.5, 1.5)) : Vec<2>::Constant(kPressure);
  DynamicsSettings settings = settings_of(start);
  // The skin of the lists comes from ten chunks that are not timed.
  Packing<2> packing = moved_for(start, stress, 10 * kStepsPerChunk * settings.time_step, settings);
  std::int64_t updates = 0;
  for (auto _ : state) {
    const auto dynamics = make_dynamics(packing, loaded(packing, stress), settings);
    dynamics->advance(kStepsPerChunk, Motion::free);
    settings.skin = dynamics->skin();
    packing = dynamics->packing();
    updates += kStepsPerChunk * static_cast<std::int64_t>(packing.contacts.size());
  }
  state.SetItemsProcessed(updates);
  state.counters["contacts"] = static_cast<double>(packing.contacts.size());
  state.counters["skin"] = settings.skin;
}

BENCHMARK(size_ratio)
    ->Apply([](benchmark::internal::Benchmark* b) {
      b->ArgNames({"ratio", "by_area", "load"});
      std::vector<std::int64_t> ratios = {2, 30};
      if (const char* ratio = std::getenv("FLOC_BENCH_RATIO")) ratios.push_back(std::atoi(ratio));
      for (const Sizes sizes : {kUniform, kUniformByArea})
        for (const Load load : {kIsotropic, kBiaxial})
          for (const std::int64_t ratio : ratios) b->Args({ratio, sizes, load});
    })
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace floc
