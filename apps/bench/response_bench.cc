// Benchmark of the linear response of a contact network, for packings made of periodic copies of a relaxed state:
//   FLOC_BENCH_STATE=state.h5 floc_bench --benchmark_filter='response/grains:90000'
// Without a state, a triangular lattice of disks is used. Grains are renumbered along a space-filling curve, as in
// runs. Each stiffness is changed at random by up to half a percent, so that the periodic copies differ from each
// other. The network of spheres is an fcc lattice from which bonds are removed at random until the coordination number
// z is 6, or copies of the state FLOC_BENCH_SPHERES, such as
//   floc convert data/packings/yade/spheres.txt spheres.h5 --contacts data/packings/yade/spheres.interactions
// The counter peak_MB is the peak memory of the whole process, so only one case should be selected per call.

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <random>

#include "floc/contact/law_parameters.h"
#include "floc/elasticity/elastic_response.h"
#include "floc/io/state_file.h"
#include "floc/linalg/blas.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/neighbors/space_order.h"
#include "floc/packing/tile.h"

namespace floc {
namespace {

/// Returns the processor time that a function takes (s). Unlike wall time, processor time does not depend on other
/// programs.
double seconds_of(const auto& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Returns the system time that this process has used so far (s). Most of it goes into the allocation of memory. For the
/// same computation it can differ by a factor of three, depending on the state of the machine.
double system_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_stime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_stime.tv_usec);
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Renumbers the grains of a packing along a space-filling curve, and adapts the grain indices of its contacts.
template <int Dim>
void renumber(Packing<Dim>& packing) {
  const std::vector<int> order = space_order(packing.cell, packing.grains);
  std::vector<int> place(order.size());
  Grains<Dim> grains = packing.grains;
  grains.position_low.clear();
  for (int k = 0; k < static_cast<int>(order.size()); ++k) {
    place[order[k]] = k;
    grains.position[k] = packing.grains.position[order[k]];
    grains.radius[k] = packing.grains.radius[order[k]];
  }
  packing.grains = std::move(grains);
  for (Contact<Dim>& c : packing.contacts) c.i = place[c.i], c.j = place[c.j];
}

/// Makes a large packing of periodic copies of `unit` along each lattice vector, and renumbers its grains.
template <int Dim>
Packing<Dim> large(const Packing<Dim>& unit, const Vec<Dim, int>& copies) {
  Packing<Dim> packing = tiled(unit, copies);
  renumber(packing);
  return packing;
}

void jitter(auto& contacts) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> percent(0.995, 1.005);
  for (auto& c : contacts) c.kn *= percent(engine), c.kt *= percent(engine), c.kr *= percent(engine);
}

LawParameters lattice_law() {
  LawParameters law;
  law.normal = LinearRepulsion{1.0};
  law.friction = CoulombFriction{0.5, 1.0};
  law.rolling = RollingSpring{0.005, 1e-4};
  return law;
}

/// Returns one unit cell of a lattice. The centres of grains that touch are at the distance 1.
template <int Dim>
Packing<Dim> lattice() {
  Packing<Dim> packing;
  packing.law = lattice_law();
  if constexpr (Dim == 2)
    packing.cell.matrix << 1.0, 0.0, 0.5, std::sqrt(0.75);
  else
    packing.cell.matrix << 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0;
  if constexpr (Dim == 3) packing.cell.matrix *= std::sqrt(0.5);
  packing.grains = Grains<Dim>::with_size(1);
  packing.grains.radius[0] = 0.505;
  find_contacts(packing);
  return packing;
}

ContactNetwork<2> disks(int n) {
  const char* file = std::getenv("FLOC_BENCH_STATE");
  const Packing<2> unit = file == nullptr ? lattice<2>() : std::get<State<2>>(read_state(file)).packing;
  const auto side = static_cast<int>(std::lround(std::sqrt(n / static_cast<double>(unit.grains.size()))));
  Packing<2> packing = large<2>(unit, {side, side});
  jitter(packing.contacts);
  return contact_network(packing);
}

/// Returns the contact network of about n spheres. The spheres are copies of the packing in the file FLOC_BENCH_SPHERES
/// or, without this variable, an fcc lattice with some bonds removed.
ContactNetwork<3> spheres(int n) {
  const char* file = std::getenv("FLOC_BENCH_SPHERES");
  const Packing<3> unit = file == nullptr ? lattice<3>() : std::get<State<3>>(read_state(file)).packing;
  const double n_tiles = n / static_cast<double>(unit.grains.size());
  const auto side = static_cast<int>(std::lround(std::cbrt(0.8 * n_tiles)));
  const auto height = static_cast<int>(std::lround(n_tiles / (side * side)));
  Packing<3> packing = large<3>(unit, {side, side, height});
  jitter(packing.contacts);
  if (file == nullptr) {
    std::mt19937 engine(2);
    std::erase_if(packing.contacts, [&](const Contact<3>&) { return engine() % 2 == 0; });
  }
  return contact_network(packing);
}

/// Measures the times to assemble, order and factorize the stiffness matrix and to solve for two right-hand sides. A
/// shift of the diagonal makes the matrix positive definite, so that no grain has to be fixed.
template <int Dim>
void solve_stages(benchmark::State& state, const ContactNetwork<Dim>& network) {
  double unit = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts) unit = std::max(unit, c.kn);
  StiffnessMatrix k;
  SymmetricFactor factor;
  std::vector<int> grain_of(network.n_unknowns());
  for (int u = 0; u < network.n_unknowns(); ++u) grain_of[u] = u / kDofs<Dim>;
  const double system_before = system_seconds();
  const double assemble = seconds_of([&] { k = stiffness_matrix(network, {}); });
  const double copy = seconds_of([&] { factor.set_matrix(k.grains, grain_of); });
  k.grains = {};
  bool positive = false;
  const double first = seconds_of([&] { positive = factor.factorize_positive(1e-6 * unit); });
  if (!positive) return state.SkipWithError("the stiffness matrix is not positive definite");
  const double solve = seconds_of([&] { benchmark::DoNotOptimize(factor.solve(k.border.leftCols(2), 0)); });
  state.counters["peak_MB"] = peak_megabytes();
  state.counters["system_s"] = system_seconds() - system_before;
  const double numeric = seconds_of([&] { positive = factor.factorize_positive(1e-6 * unit); });
  state.counters["assemble_s"] = assemble + copy;
  state.counters["analyse_s"] = first - numeric;
  state.counters["factor_s"] = numeric;
  state.counters["solve_s"] = solve;
  state.counters["total_s"] = assemble + copy + first + solve;
  state.counters["contacts"] = static_cast<double>(network.contacts.size());
  state.SetLabel(blas_library());
}

void stages(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  for (auto _ : state) {
    if (state.range(1) == 2)
      solve_stages(state, disks(n));
    else
      solve_stages(state, spheres(n));
  }
}
BENCHMARK(stages)
    ->ArgNames({"grains", "dimension"})
    ->Args({1400, 2})
    ->Args({12600, 2})
    ->Args({90000, 2})
    ->Args({1000000, 2})
    ->Args({10000, 3})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

/// Measures the time to compute the whole response with its error bound, as the command `floc moduli` computes it.
void response(benchmark::State& state) {
  const ContactNetwork<2> network = disks(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const ElasticResponse answer = elastic_response(network, {});
    state.counters["condition"] = answer.condition;
    state.counters["relative_error"] =
        (answer.error.diagonal().array() / answer.relaxed.diagonal().array()).maxCoeff();
  }
  state.counters["peak_MB"] = peak_megabytes();
}
BENCHMARK(response)->ArgName("grains")->Arg(1400)->Arg(12600)->Arg(90000)->Arg(1000000)->Iterations(1)->Unit(
    benchmark::kSecond);

}  // namespace
}  // namespace floc
