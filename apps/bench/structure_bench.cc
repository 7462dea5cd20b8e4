// Benchmark of the quantities that `floc network` and `floc structure` compute, for periodic copies of a state:
//   FLOC_BENCH_STATE=state.h5 floc_bench --benchmark_filter='network|structure'
// Without a state, a triangular lattice of disks is used. The time to read the file is not included.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>

#include "floc/contact/law_parameters.h"
#include "floc/elasticity/force_correlation.h"
#include "floc/elasticity/network_mechanics.h"
#include "floc/io/state_file.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/network/rattlers.h"
#include "floc/packing/tile.h"
#include "floc/structure/coordination.h"
#include "floc/structure/force_distribution.h"
#include "floc/structure/force_moments.h"
#include "floc/structure/gap_coordination.h"
#include "floc/structure/pair_correlation.h"
#include "floc/structure/particle_stress.h"
#include "floc/structure/pores.h"
#include "floc/structure/pressure_phases.h"
#include "floc/structure/pushed_rattlers.h"
#include "floc/structure/scattering.h"

namespace floc {
namespace {

Packing<2> unit_packing() {
  if (const char* file = std::getenv("FLOC_BENCH_STATE")) return std::get<State<2>>(read_state(file)).packing;
  Packing<2> packing;
  LawParameters law;
  law.normal = LinearRepulsion{1.0};
  law.friction = CoulombFriction{0.5, 1.0};
  law.rolling = RollingSpring{0.005, 1e-4};
  packing.law = law;
  packing.cell.matrix << 1.0, 0.0, 0.5, std::sqrt(0.75);
  packing.grains = Grains<2>::with_size(1);
  packing.grains.radius[0] = 0.505;
  find_contacts(packing);
  return packing;
}

/// Returns a packing of at least n grains: periodic copies of the given state or, without a state, of the lattice.
Packing<2> packing_of(int n) {
  const Packing<2> unit = unit_packing();
  const auto side = static_cast<int>(std::ceil(std::sqrt(n / static_cast<double>(unit.grains.size()))));
  return tiled<2>(unit, {side, side});
}

void network(benchmark::State& state) {
  const Packing<2> packing = packing_of(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const ModuliOptions options;
    const ContactNetwork<2> contacts = options.loaded_network(packing);
    const Moduli moduli = elastic_moduli(packing, options);
    const ContactMechanics<2> mechanics = contact_mechanics(contacts, moduli);
    benchmark::DoNotOptimize(network_mechanics(packing, contacts, moduli, mechanics));
    if (mechanics.isotropic)
      benchmark::DoNotOptimize(force_correlation(contacts, mechanics.isotropic->increments));
    benchmark::DoNotOptimize(coordination(packing, 1e-5));
    benchmark::DoNotOptimize(force_moments(packing));
    benchmark::DoNotOptimize(pressure_phases(contacts, particle_pressure(packing)));
    for (const ForceKind kind : {ForceKind::normal, ForceKind::tangential, ForceKind::rolling})
      benchmark::DoNotOptimize(force_distribution(packing, kind, ForceUnit::mean, 0.1));
  }
  state.counters["grains"] = packing.grains.size();
}

void structure(benchmark::State& state) {
  const Packing<2> packing = packing_of(static_cast<int>(state.range(0)));
  const std::vector<double> gaps = {0.0, 1e-4, 1e-3, 1e-2, 1e-1, 1.0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(scattering(packing));
    benchmark::DoNotOptimize(find_pores(packing));
    benchmark::DoNotOptimize(pair_correlation(packing, 5.0, 250));
    benchmark::DoNotOptimize(gap_coordination(packing, gaps));
    benchmark::DoNotOptimize(
        gap_coordination(with_pushed_rattlers(packing, find_rattlers(packing, 1e-5)), gaps));
  }
  state.counters["grains"] = packing.grains.size();
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgName("grains")->Arg(1400)->Arg(100000)->Iterations(1)->MeasureProcessCPUTime()->Unit(
      benchmark::kSecond);
}
BENCHMARK(network)->Apply(sizes);
BENCHMARK(structure)->Apply(sizes);

}  // namespace
}  // namespace floc
