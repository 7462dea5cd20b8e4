// Benchmark of the time stepping of spheres, in contact updates per second. Elastic spheres (Hertz, Mindlin friction,
// damping) and spheres with a linear law are run for each number of grains and instruction set. Other cases are wet
// spheres, and sticky spheres with and without walls. Times are processor times:
//   floc_bench --benchmark_filter='spheres|box'

#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "floc/assembly/box_options.h"
#include "floc/assembly/gas.h"
#include "floc/contact/law_parameters.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/tile.h"
#include "floc/relaxation/relaxer.h"
#include "step_bench.h"

namespace floc {
namespace {

constexpr int kUnit = 500;  ///< number of grains of the packing that larger packings repeat

enum Law { kHertz, kLinear, kLinearRolling, kWet };

/// Returns a contact law. The units are the diameter and mass of a grain, and its modulus E~ (Hertz) or stiffness K_N
/// (linear).
LawParameters law_of(int which) {
  LawParameters law;
  if (which == kHertz) {
    law.normal = HertzRepulsion{0.91, 0.3};
    law.damping = CriticalDamping{0.98};
    law.friction = MindlinFriction{0.3};
    return law;
  }
  law.normal = LinearRepulsion{1.0};
  law.damping = ViscousDamping{0.1, DampingMass::effective};
  law.friction = CoulombFriction{0.3, 0.8};
  if (which == kLinearRolling) law.rolling = RollingSpring{0.005, 1e-4};
  // Water between grains with diameters a of 1 to 2 mm: K_N a/f0 = 3300 and P a^2/f0 = 0.33, with the stiffness K_N,
  // the pressure P and the capillary force f0.
  if (which == kWet) law.adhesion = CapillaryAdhesion{9.65e-5, 0.0, 0.007, 2.6};
  return law;
}

/// Relaxes a gas to equilibrium under a pressure P. For Hertz contacts, P gives the stiffness number kappa =
/// (E~/P)^(2/3) = 8395 (glass at 100 kPa); for linear contacts, P = 1e-4 K_N/a (stiffness K_N, diameter a).
Packing<3> relaxed_from_gas(int which) {
  GrainOptions grains;
  grains.count = kUnit;
  grains.diameter.min = grains.diameter.max = 1.0;
  RandomStream random(1, 1);
  RelaxationOptions options;
  options.inertial_number_cap = 0.03;
  const double pressure = which == kHertz ? std::pow(8395.0, -1.5) : 1e-4;
  const auto relaxed = [&](Packing<3> packing) {
    Relaxer<3> relaxer(options, std::move(packing), Vec<3>::Constant(pressure));
    while (relaxer.advance() == RelaxationStatus::running) continue;
    return relaxer.packing();
  };
  if (which != kWet) return relaxed(make_gas<3>(grains, law_of(which), 0.45, random));
  Packing<3> packing = relaxed(make_gas<3>(grains, law_of(kLinear), 0.45, random));
  packing.law = law_of(kWet);
  find_contacts(packing);
  return relaxed(std::move(packing));
}

/// Returns a relaxed packing of at least n grains with a contact law. A packing with more than kUnit grains consists of
/// periodic copies of the packing with kUnit grains. Each packing is made only once.
const Packing<3>& dense(int n, int which) {
  static std::map<std::tuple<int, int>, Packing<3>> made;
  const auto [entry, is_new] = made.try_emplace({n, which});
  Packing<3>& packing = entry->second;
  if (!is_new) return packing;
  if (n == kUnit) return packing = relaxed_from_gas(which);
  const int across = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(n) / kUnit) - 1e-9));
  return packing = tiled<3>(dense(kUnit, which), {across, across, across});
}

void spheres(benchmark::State& state) {
  step(state, dense(static_cast<int>(state.range(0)), static_cast<int>(state.range(1))),
       RelaxationOptions{}.time_step, 1, static_cast<InstructionSet>(state.range(2)));
}
BENCHMARK(spheres)
    ->ArgNames({"grains", "law", "instructions"})
    ->ArgsProduct({{4000, 108000},
                   {kHertz, kLinear, kLinearRolling, kWet},
                   {static_cast<int>(InstructionSet::avx512)}})
    ->ArgsProduct({{4000},
                   {kHertz},
                   {static_cast<int>(InstructionSet::portable), static_cast<int>(InstructionSet::avx2)}})
    ->Unit(benchmark::kMillisecond);

/// Returns sticky spheres that six walls have compressed from a gas, with the reduced cohesion eta* = 0.05 of
/// [SVI2024]. The units are the diameter and the mass of a sphere and the pressure.
Packing<3> compacted(int n) {
  constexpr double kPressure = 1.0, kStiffness = 1e4, kAdhesion = 5.0;
  LawParameters law;
  law.normal = LinearRepulsion{kStiffness};
  law.adhesion = ConstantAdhesion{kAdhesion};
  law.damping = ViscousDamping{0.1, DampingMass::effective};
  law.friction = CoulombFriction{0.4, 0.8 * kStiffness};
  GrainOptions grains;
  grains.count = n;
  grains.diameter.min = grains.diameter.max = 1.0;
  RandomStream random(1, 1);
  BoxOptions box;
  box.mass = 1000.0;
  Packing<3> packing = make_boxed_gas<3>(grains, law, box, 0.3, random);
  const DynamicsSettings settings{time_step_of(packing, RelaxationOptions{}.time_step, kPressure), 0.05, 1};
  auto control = BoundaryControl<3>::fixed();
  for (int a = 0; a < 3; ++a) control.imposed[a] = Imposed::stress, control.target[a] = kPressure;
  const auto dynamics = make_dynamics(packing, control, settings);
  dynamics->advance(static_cast<int>(5.0 / settings.time_step), Motion::free);
  if (!dynamics->finite()) throw std::runtime_error("the walls went through the spheres");
  return dynamics->packing();
}

/// Removes the walls of a packing and puts its grains into a periodic cell. The contacts between grains are kept. No
/// contact is added across the boundary of the cell, because the grains there touched the walls and not each other.
Packing<3> without_walls(Packing<3> packing) {
  for (const Wall<3>& wall : packing.walls)
    if (wall.side < 0)
      for (Vec<3>& x : packing.grains.position) x[wall.axis] -= wall.position;
  std::erase_if(packing.contacts, [&](const Contact<3>& c) { return packing.is_wall(c.j); });
  packing.walls.clear();
  return packing;
}

void box(benchmark::State& state) {
  static const Packing<3> boxed = compacted(17657);
  static const Packing<3> periodic = without_walls(boxed);
  const Packing<3>& packing = state.range(0) != 0 ? boxed : periodic;
  DynamicsSettings settings{time_step_of(packing, RelaxationOptions{}.time_step, 1.0), 0.05, 1};
  settings.instructions = widest_instruction_set();
  const auto dynamics = make_dynamics(packing, BoundaryControl<3>::fixed(), settings);
  constexpr int kSteps = 100;
  for (auto _ : state) dynamics->advance(kSteps, Motion::free);
  state.SetItemsProcessed(state.iterations() * kSteps * static_cast<std::int64_t>(packing.contacts.size()));
  state.counters["contacts"] = static_cast<double>(packing.contacts.size());
}
BENCHMARK(box)->ArgName("walls")->Arg(0)->Arg(1)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace floc
