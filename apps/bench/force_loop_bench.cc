// Contact updates per second of the time stepping, law by law: what a scene pays for the physics it names. Compare the
// rows of one run; single figures depend on the machine.

#include <benchmark/benchmark.h>

#include <map>
#include <tuple>

#include "floc/assembly/gas.h"
#include "floc/elasticity/stability.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/relaxation_options.h"

namespace floc {
namespace {

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

CellControl<2> pressed(const Packing<2>& packing) {
  CellControl<2> control;
  control.target = Vec<2>::Constant(10.0);
  for (const double m : packing.grains.mass) control.mass += m;
  return control;
}

DynamicsSettings settings_of(const Packing<2>& packing, int threads) {
  return {time_step_of(packing, RelaxationOptions{}.time_step), 0.05, threads};
}

/// A dense packing under P = 10 F0/a, made once for each law and size.
const Packing<2>& dense(int n, int physics, bool adhesive) {
  static std::map<std::tuple<int, int, bool>, Packing<2>> made;
  const auto [entry, is_new] = made.try_emplace({n, physics, adhesive});
  Packing<2>& packing = entry->second;
  if (!is_new) return packing;
  GrainOptions grains;
  grains.count = n;
  grains.diameter.min = 0.5;
  grains.diameter.max = 1.0;
  RandomStream random(1, 1);
  packing = make_gas<2>(grains, law_of(physics, adhesive), 0.55, random);
  const auto dynamics = make_dynamics(packing, pressed(packing), settings_of(packing, 1));
  dynamics->advance(20000, Motion::free);
  return packing = dynamics->packing();
}

void force_loop(benchmark::State& state) {
  const Packing<2>& packing =
      dense(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), state.range(2) != 0);
  const auto dynamics =
      make_dynamics(packing, pressed(packing), settings_of(packing, static_cast<int>(state.range(3))));
  constexpr int kSteps = 100;
  for (auto _ : state) dynamics->advance(kSteps, Motion::free);
  state.SetItemsProcessed(state.iterations() * kSteps * static_cast<std::int64_t>(packing.contacts.size()));
}
BENCHMARK(force_loop)
    ->ArgNames({"grains", "physics", "adhesive", "threads"})
    ->ArgsProduct({{1400}, {kFrictionless, kFriction, kFrictionAndRolling}, {0, 1}, {1}})
    ->Args({5600, kFrictionAndRolling, 1, 1})
    ->Args({5600, kFrictionAndRolling, 1, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

void stability(benchmark::State& state) {
  const Packing<2>& packing = dense(static_cast<int>(state.range(0)), kFrictionAndRolling, true);
  for (auto _ : state) benchmark::DoNotOptimize(count_negative_eigenvalues(packing));
}
BENCHMARK(stability)->ArgName("grains")->Arg(1400)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace floc
