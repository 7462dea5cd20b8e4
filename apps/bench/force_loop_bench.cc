// Contact updates per second of the time stepping, law by law, size by size and for each instruction set: what a scene
// pays for the physics it names. Time is that of the processor. Compare the rows of one run; single figures depend on
// the machine. FLOC_BENCH_GRAINS=1000000 adds a size.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <tuple>

#include "floc/assembly/gas.h"
#include "floc/elasticity/stability.h"
#include "floc/packing/tile.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/relaxer.h"

namespace floc {
namespace {

constexpr int kUnit = 1400;  ///< grains of the packing that larger ones are tiled from

enum Physics { kFrictionless, kFriction, kFrictionAndRolling };

/// The law of G08 in units F0 = a = m = 1, with the slots asked for.
LawParameters law_of(int physics, bool adhesive) {
  LawParameters law;
  law.normal_stiffness = 1e5;
  law.damping = {0.015, DampingMass::effective};
  if (adhesive) law.adhesion = {1.0, 1e-3};
  if (physics >= kFriction) law.friction = {0.5, 1e5};
  if (physics == kFrictionAndRolling) law.rolling = {0.005, 10.0};
  return law;
}

RelaxationOptions relaxation() {
  RelaxationOptions options;
  options.inertial_number_cap = 0.03;
  return options;
}

CellControl<2> pressed(const Packing<2>& packing) {
  CellControl<2> control;
  control.target = Vec<2>::Constant(10.0);
  for (const double m : packing.grains.mass) control.mass += m;
  return control;
}

/// A gas compressed to equilibrium under P = 10 F0/a, that is P/K_N = 1e-4.
Packing<2> relaxed_from_gas(int n, const LawParameters& law) {
  GrainOptions grains;
  grains.count = n;
  grains.diameter.min = 0.5;
  grains.diameter.max = 1.0;
  RandomStream random(1, 1);
  Relaxer<2> relaxer(relaxation(), make_gas<2>(grains, law, 0.36, random), Vec<2>::Constant(10.0));
  while (relaxer.advance() == RelaxationStatus::running) continue;
  return relaxer.packing();
}

/// The equilibrium of a law, tiled to at least n grains; each is made once.
const Packing<2>& dense(int n, int physics, bool adhesive) {
  static std::map<std::tuple<int, int, bool>, Packing<2>> made;
  const auto [entry, is_new] = made.try_emplace({n, physics, adhesive});
  Packing<2>& packing = entry->second;
  if (!is_new) return packing;
  if (n == kUnit) return packing = relaxed_from_gas(n, law_of(physics, adhesive));
  const int across = static_cast<int>(std::sqrt(static_cast<double>(n) / kUnit));
  return packing =
             tiled<2>(dense(kUnit, physics, adhesive), {across, (n + across * kUnit - 1) / (across * kUnit)});
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void force_loop(benchmark::State& state) {
  const Packing<2>& packing =
      dense(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), state.range(2) != 0);
  DynamicsSettings settings{time_step_of(packing, relaxation().time_step), 0.01,
                            static_cast<int>(state.range(3))};
  settings.instructions = static_cast<InstructionSet>(state.range(4));
  if (!supported(settings.instructions)) return state.SkipWithError("not on this processor");
  const auto dynamics = make_dynamics(packing, pressed(packing), settings);
  const int n_steps = packing.grains.size() > 50000 ? 20 : 200;
  for (auto _ : state) dynamics->advance(n_steps, Motion::free);
  state.SetItemsProcessed(state.iterations() * n_steps * static_cast<std::int64_t>(packing.contacts.size()));
  state.counters["contacts"] = static_cast<double>(packing.contacts.size());
  state.counters["peak_MB"] = peak_megabytes();
}

constexpr int kWidest = static_cast<int>(InstructionSet::avx512);

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"grains", "physics", "adhesive", "threads", "instructions"});
  for (const int physics : {kFrictionless, kFriction, kFrictionAndRolling})
    for (const int adhesive : {0, 1}) b->Args({kUnit, physics, adhesive, 1, kWidest});
  for (const int set : {0, 1}) {
    b->Args({kUnit, kFriction, 0, 1, set});
    b->Args({kUnit, kFrictionAndRolling, 1, 1, set});
  }
  for (const int n : {10976, 100000}) b->Args({n, kFriction, 0, 1, kWidest});
  for (const int threads : {1, 2}) b->Args({5600, kFrictionAndRolling, 1, threads, kWidest});
  if (const char* n = std::getenv("FLOC_BENCH_GRAINS")) b->Args({std::atoi(n), kFriction, 0, 1, kWidest});
}
BENCHMARK(force_loop)->Apply(sizes)->MeasureProcessCPUTime()->Unit(benchmark::kMicrosecond);

/// From the gas to equilibrium under P/K_N = 1e-4 with friction, to the default tolerance.
void gas_to_equilibrium(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(relaxed_from_gas(kUnit, law_of(kFriction, false)));
}
BENCHMARK(gas_to_equilibrium)->Unit(benchmark::kSecond);

void stability(benchmark::State& state) {
  const Packing<2>& packing = dense(static_cast<int>(state.range(0)), kFrictionAndRolling, true);
  for (auto _ : state) benchmark::DoNotOptimize(count_negative_eigenvalues(packing));
}
BENCHMARK(stability)->ArgName("grains")->Arg(kUnit)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace floc
