// Benchmark of packings of grains of different sizes.
//
// In 2D the benchmark measures contact updates per second of the time stepping; the time to make new lists of pairs is
// included. Disks with friction and size ratios 1:2 and 1:30 are under a pressure of 1e-4 times the normal stiffness.
// Their diameters d have a uniform distribution, as in scenes, or a distribution that is uniform by area, P(d) ~ d^-2
// (Voivret et al., Phys. Rev. Lett. 102, 178001), in which most grains are small and touch no other grain. Compare only
// results for one distribution from one call. FLOC_BENCH_RATIO=100 adds the size ratio 1:100.
//
// In 3D the benchmark measures pairs found per second and contact updates per second. The spheres have one size, or a
// size ratio 1:20 with a distribution uniform by volume, P(d) ~ d^-3. The packing is a gas whose spheres have been
// enlarged until some touch.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <map>
#include <numeric>
#include <tuple>

#include "floc/assembly/gas.h"
#include "floc/contact/law_parameters.h"
#include "floc/neighbors/pairs.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/relaxer.h"

namespace floc {
namespace {

constexpr int kGrains = 5000;
constexpr double kPressure = 10.0;  ///< pressure; the normal stiffness in the same units is 1e5

enum Load {
  kIsotropic,  ///< isotropic pressure: the packing comes to rest
  kBiaxial,    ///< stress of 0.5 times the pressure on one axis and 1.5 times on the other: the packing flows
};

enum Sizes {
  kUniform,        ///< probability density P(d) of diameters is constant
  kUniformByArea,  ///< probability density P(d) of diameters is proportional to d^-2
};

/// Returns n diameters from 1/ratio to 1: equally spaced quantiles of the distribution `sizes`.
std::vector<double> diameters(int n, double ratio, Sizes sizes) {
  std::vector<double> diameter(n);
  for (int i = 0; i < n; ++i) {
    const double share = static_cast<double>(i) / (n - 1);
    diameter[i] = sizes == kUniform ? 1.0 - (1.0 - 1.0 / ratio) * share : 1.0 / (1.0 + (ratio - 1.0) * share);
  }
  return diameter;
}

template <int Dim>
BoundaryControl<Dim> loaded(const Packing<Dim>& packing, const Vec<Dim>& stress) {
  RelaxationOptions options;
  options.inertial_number_cap = 0.03;
  const double mass = 0.01 * std::accumulate(packing.grains.mass.begin(), packing.grains.mass.end(), 0.0);
  return BoundaryControl<Dim>::normal_stress(stress, mass, strain_rate_cap(options, packing, stress));
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

template <int Dim>
DynamicsSettings settings_of(const Packing<Dim>& packing) {
  return {time_step_of(packing, RelaxationOptions().time_step), 0.01};
}

/// Returns a packing under load. A gas is compressed isotropically, for 1.5 times as long as it needs to become dense.
/// For a biaxial load, the resulting packing is then loaded biaxially. Each packing is made only once.
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
  // Ten chunks of time steps come before the measurement. In these steps the skin (margin of the lists of pairs) adapts
  // to the motion.
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

/// Returns a packing of spheres, placed without overlap at a solid fraction of 0.45 and then enlarged by 6 %. Each
/// packing is made only once.
const Packing<3>& grown_gas(double ratio) {
  static std::map<double, Packing<3>> made;
  const auto [entry, is_new] = made.try_emplace(ratio);
  Packing<3>& packing = entry->second;
  if (!is_new) return packing;
  GrainOptions grains;
  grains.count = 8000;
  grains.diameter.kind = DiameterDistribution::Kind::power_law;
  grains.diameter.exponent = kUniformByVolume;
  grains.diameter.min = 1.0 / ratio;
  grains.diameter.max = 1.0;
  LawParameters law;
  law.normal = LinearRepulsion{1e5};
  law.damping = ViscousDamping{0.015, DampingMass::effective};
  law.friction = CoulombFriction{0.5, 1e5};
  RandomStream random(1, 1);
  packing = make_gas<3>(grains, law, 0.45, random);
  for (double& R : packing.grains.radius) R *= 1.06;
  return packing;
}

void pairs_of_spheres(benchmark::State& state) {
  const Packing<3>& packing = grown_gas(static_cast<double>(state.range(0)));
  const double gap = 0.1 * skin_length_unit(packing.grains.radius);
  std::size_t n = 0;
  for (auto _ : state) n = find_pairs(packing.cell, packing.grains, gap).size();
  state.SetItemsProcessed(static_cast<std::int64_t>(n) * static_cast<std::int64_t>(state.iterations()));
  state.counters["pairs"] = static_cast<double>(n);
}

void steps_of_spheres(benchmark::State& state) {
  const Packing<3>& packing = grown_gas(static_cast<double>(state.range(0)));
  const Vec<3> stress = Vec<3>::Constant(kPressure);
  DynamicsSettings settings = settings_of(packing);
  std::int64_t updates = 0;
  for (auto _ : state) {
    const auto dynamics = make_dynamics(packing, loaded(packing, stress), settings);
    dynamics->advance(kStepsPerChunk, Motion::free);
    settings.skin = dynamics->skin();
    updates += kStepsPerChunk * static_cast<std::int64_t>(dynamics->packing().contacts.size());
  }
  state.SetItemsProcessed(updates);
}

BENCHMARK(pairs_of_spheres)->Arg(1)->Arg(20)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK(steps_of_spheres)->Arg(1)->Arg(20)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
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
