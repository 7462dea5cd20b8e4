// Benchmark of the time stepping of disks. The results are contact updates per second for each contact law, number of
// grains and instruction set. Times are processor times. Compare only results of the same call, because the speed
// depends on the state of the machine. The environment variable FLOC_BENCH_GRAINS=1000000 adds a packing with this
// number of grains; FLOC_BENCH_STATE=state.h5 adds a packing from a state file.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <tuple>
#include <variant>

#include "floc/assembly/gas.h"
#include "floc/contact/law_parameters.h"
#include "floc/contact/law_table.h"
#include "floc/elasticity/stability.h"
#include "floc/io/state_file.h"
#include "floc/neighbors/space_order.h"
#include "floc/packing/balance.h"
#include "floc/packing/tile.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interaction.h"
#include "floc/relaxation/kernels/kernel_law.h"
#include "floc/relaxation/pair_arrays.h"
#include "floc/relaxation/relaxer.h"
#include "floc/relaxation/row_sums.h"
#include "step_bench.h"

namespace floc {
namespace {

constexpr int kUnit = 1400;  ///< number of grains of the packing that larger packings repeat

enum Physics { kFrictionless, kFriction, kFrictionAndRolling };

/// Returns the contact law of [GRC2008] in units F0 = a = m = 1 (pull-off force, largest diameter, mass), with the
/// chosen kind of friction, and with adhesion if `adhesive` is true.
LawParameters law_of(int physics, bool adhesive) {
  LawParameters law;
  law.normal = LinearRepulsion{1e5};
  law.damping = ViscousDamping{0.015, DampingMass::effective};
  if (adhesive) law.adhesion = TailAdhesion{1.0, 1e-3};
  if (physics >= kFriction) law.friction = CoulombFriction{0.5, 1e5};
  if (physics == kFrictionAndRolling) law.rolling = RollingSpring{0.005, 10.0};
  return law;
}

RelaxationOptions relaxation() {
  RelaxationOptions options;
  options.inertial_number_cap = 0.03;
  return options;
}

/// Compresses a gas of disks to equilibrium under the pressure P = 10 F0/a, so that P/K_N = 1e-4 (K_N: normal
/// stiffness).
Packing<2> relaxed_from_gas(int n, const LawParameters& law, double cell_mass) {
  GrainOptions grains;
  grains.count = n;
  grains.diameter.min = 0.5;
  grains.diameter.max = 1.0;
  RandomStream random(1, 1);
  RelaxationOptions options = relaxation();
  options.cell_mass = cell_mass;
  Relaxer<2> relaxer(options, make_gas<2>(grains, law, 0.36, random), Vec<2>::Constant(10.0));
  while (relaxer.advance() == RelaxationStatus::running) continue;
  return relaxer.packing();
}

/// Returns a packing of at least n grains in equilibrium under a contact law. A packing with more than kUnit grains
/// consists of periodic copies of the packing with kUnit grains. Each packing is made only once.
const Packing<2>& dense(int n, int physics, bool adhesive) {
  static std::map<std::tuple<int, int, bool>, Packing<2>> made;
  const auto [entry, is_new] = made.try_emplace({n, physics, adhesive});
  Packing<2>& packing = entry->second;
  if (!is_new) return packing;
  if (n == kUnit) return packing = relaxed_from_gas(n, law_of(physics, adhesive), 1.0);
  const int across = static_cast<int>(std::sqrt(static_cast<double>(n) / kUnit));
  return packing =
             tiled<2>(dense(kUnit, physics, adhesive), {across, (n + across * kUnit - 1) / (across * kUnit)});
}

void force_loop(benchmark::State& state) {
  step(state, dense(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), state.range(2) != 0),
       relaxation().time_step, static_cast<int>(state.range(3)), static_cast<InstructionSet>(state.range(4)));
}

/// Measures the processor times of the three passes of a time step, and the time to make a new list of pairs. Each of
/// these four times is divided by the time of all three passes. The grains do not move.
void passes(benchmark::State& state) {
  const Packing<2>& packing = dense(static_cast<int>(state.range(0)), kFriction, false);
  const ComposedLaw law{compose_law(packing.law)};
  const AnyKernelLaw<2> in_kernel = kernel_law<2>(law.any, Partner::grain);
  const void* const composed = address_of_alternative(in_kernel);
  GrainArrays<2> grains(packing.grains, space_order(packing.cell, packing.grains));
  const auto x_list = grains.x;
  Grains<2> ordered = Grains<2>::with_size(grains.size());
  grains.copy_positions_to(ordered);
  std::copy_n(grains.radius.begin(), grains.size(), ordered.radius.begin());
  const auto new_pairs = [&] {
    return PairArrays<2>(find_pairs(packing.cell, ordered, 0.005), Partner::grain, grains, law, 1e-4, 1);
  };
  PairArrays<2> pairs = new_pairs();
  const StepKernels<2>& kernels =
      step_kernels<2>(widest_instruction_set(), LatticeShape::rectangular, in_kernel.index());
  const AlignedVector<double> inverse_skin_squared(grains.x[0].size(), 0.0);
  const GrainView<2> g = grains.view(x_list, inverse_skin_squared);
  const int n_blocks = (grains.size() + kGrainBlock - 1) / kGrainBlock;
  // All grains form a single group, so that each pass covers all pairs. Otherwise each pass would cover only the pairs
  // of one group.
  const auto rows_of = [&](const PairArrays<2>& list) {
    return RowSums<2>({&list}, row_kind<2>(law), grains.size(), SweepPlan(list, n_blocks, 1, n_blocks));
  };
  RowSums<2> row_sums = rows_of(pairs);
  PairView<2> p = pairs.view();
  p.row = row_sums.rows_of_group(0);
  const PairCell<2> cell{{{packing.cell.matrix(0, 0), 0.0}, {0.0, packing.cell.matrix(1, 1)}}, {}, 0.0, {}};
  const Kick<2> kick{0.0, {{1.0, 0.0}, {0.0, 1.0}}, {{1.0, 0.0}, {0.0, 1.0}}};
  const Drift<2> drift{{{1.0, 0.0}, {0.0, 1.0}}, {}};
  BlockSums<2> sums;
  double seconds[4] = {};
  const auto clocked = [&](double& total, const auto& pass) {
    const std::clock_t start = std::clock();
    for (int k = 0; k < 200; ++k)
      for (int b = 0; b < n_blocks; ++b) pass(b);
    total += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / 200;
  };
  for (auto _ : state) {
    clocked(seconds[0],
            [&](int b) { kernels.kick_and_drift(g, b * kGrainBlock, kick, drift, Rotation::in_middle); });
    clocked(seconds[1], [&](int b) {
      kernels.compute_pairs(composed, g, p, pairs.first_of_block(b), pairs.first_of_block(b + 1), cell);
    });
    clocked(seconds[2], [&](int b) {
      kernels.sum_and_kick(g, p, row_sums.plan(b), b * kGrainBlock, cell, kick, Rotation::in_middle, sums);
    });
    const std::clock_t start = std::clock();
    const PairArrays<2> list = new_pairs();
    benchmark::DoNotOptimize(rows_of(list));
    seconds[3] += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  const double step = seconds[0] + seconds[1] + seconds[2];
  state.counters["drift"] = seconds[0] / step;
  state.counters["pairs"] = seconds[1] / step;
  state.counters["sums"] = seconds[2] / step;
  state.counters["list_in_steps"] = seconds[3] / step;
}
BENCHMARK(passes)->ArgName("grains")->Arg(kUnit)->Arg(100000)->Unit(benchmark::kMillisecond);

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

void steps_of_state(benchmark::State& state, const char* file) {
  std::visit(
      [&](const auto& read) { step(state, read.packing, relaxation().time_step, 1, widest_instruction_set()); },
      read_state(file));
}
[[maybe_unused]] const auto* const kStepsOfState = [] {
  const char* file = std::getenv("FLOC_BENCH_STATE");
  return file ? benchmark::RegisterBenchmark("steps_of_state", steps_of_state, file)->MeasureProcessCPUTime()
              : nullptr;
}();

/// Measures the time in which a gas of frictional disks reaches equilibrium (with the default tolerance) under a
/// pressure of 1e-4 times the normal stiffness. The argument is the mass of the cell in per cent of the mass of all
/// grains. A cell as heavy as all grains together oscillates four times as long as a cell with a tenth of this mass.
void gas_to_equilibrium(benchmark::State& state) {
  const double cell_mass = 0.01 * static_cast<double>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(relaxed_from_gas(kUnit, law_of(kFriction, false), cell_mass));
}
BENCHMARK(gas_to_equilibrium)->ArgName("cell_mass_percent")->Arg(10)->Arg(100)->Unit(benchmark::kSecond);

void stability(benchmark::State& state) {
  const Packing<2>& packing = dense(static_cast<int>(state.range(0)), kFrictionAndRolling, true);
  for (auto _ : state) benchmark::DoNotOptimize(floc::stability(packing));
}
BENCHMARK(stability)->ArgName("grains")->Arg(kUnit)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace floc
