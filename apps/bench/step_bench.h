#pragma once

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/dynamics.h"

namespace floc {

/// Returns a boundary condition that imposes the present normal stresses of a packing. The cell has the mass of all
/// grains together.
template <int Dim>
BoundaryControl<Dim> pressed(const Packing<Dim>& packing) {
  double mass = 0.0;
  for (const double m : packing.grains.mass) mass += m;
  return BoundaryControl<Dim>::normal_stress(static_stress(packing).diagonal(), mass);
}

/// Returns the peak memory of this process so far (MB).
inline double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Benchmarks time steps of a packing under its present stress. The benchmark counts contact updates (number of time
/// steps times number of contacts).
/// @param time_step  time step in units of sqrt(m/K_N), with the smallest mass m and the normal stiffness K_N
template <int Dim>
void step(benchmark::State& state, const Packing<Dim>& packing, double time_step, int threads,
          InstructionSet instructions) {
  DynamicsSettings settings{time_step_of(packing, time_step, static_stress(packing).trace() / Dim),
                            0.01 * largest_diameter(packing.grains), threads};
  settings.instructions = instructions;
  if (!supported(settings.instructions))
    return state.SkipWithError("this processor does not support these instructions");
  const auto dynamics = make_dynamics(packing, pressed(packing), settings);
  const int n_steps = packing.grains.size() > 50000 ? 20 : 200;
  for (auto _ : state) dynamics->advance(n_steps, Motion::free);
  state.SetItemsProcessed(state.iterations() * n_steps * static_cast<std::int64_t>(packing.contacts.size()));
  state.counters["contacts"] = static_cast<double>(packing.contacts.size());
  state.counters["peak_MB"] = peak_megabytes();
}

}  // namespace floc
