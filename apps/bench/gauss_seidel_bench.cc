// Benchmark of the sweeps of GaussSeidel over frictional contacts, in updates of contacts per second ("items"):
//   floc_bench --benchmark_filter=sweeps
// Grains on a lattice are pushed together; each grain touches some of its neighbours. The arguments are the number of
// threads, whether the cell is under stress, the approximate number of grains, and the instruction set (0: portable, 1:
// AVX2, 2: AVX-512).

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "floc/network/contact_network.h"
#include "floc/rigid/gauss_seidel.h"

namespace floc {
namespace {

template <int Dim>
struct Step {
  BodyMotion<Dim> bodies;
  std::vector<StepContact<Dim>> contacts;
};

/// Grains on a triangular lattice with 4 contacts each in 2D, and on a face-centred cubic lattice with 6 contacts each
/// in 3D. These numbers of contacts are means, because the contacts are drawn at random.
template <int Dim>
class LatticeStep {
 public:
  /// @param general  whether the vectors from the centres to the contact points have a random component along
  /// the surface
  /// @param cell     whether the cell deforms under stress
  /// @param size     approximate number of grains
  LatticeStep(bool general, bool cell, double size) : general_(general) {
    const int side = static_cast<int>(std::lround(std::pow(size, 1.0 / Dim)));
    for (int n = 0, n_places = static_cast<int>(std::pow(side, Dim)); n < n_places; ++n) {
      Vec<Dim> place;
      for (int a = 0, rest = n; a < Dim; ++a, rest /= side) place[a] = rest % side;
      add_body(place, side);
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dz = Dim == 2 ? 0 : -1; dz <= (Dim == 2 ? 0 : 1); ++dz)
            add_neighbour(n, place, {dx, dy, dz}, side);
    }
    if (cell) step_.bodies.inverse_stretch_mass.setConstant(1.0 / (step_.bodies.size() * side * side));
  }
  Step<Dim> step() const { return step_; }

 private:
  void add_body(const Vec<Dim>& place, int side) {
    const auto noise = [&] { return normal_(engine_); };
    BodyMotion<Dim>& bodies = step_.bodies;
    bodies.velocity.push_back(-(place.array() / side - 0.5).matrix() + 0.02 * Vec<Dim>::NullaryExpr(noise));
    bodies.angular_velocity.push_back(0.02 * RotationVector<Dim>::NullaryExpr(noise));
    bodies.inverse_mass.push_back(Vec<Dim>::Ones());
    Mat<kRotations<Dim>> inertia = (Dim == 2 ? 8.0 : 10.0) * Mat<kRotations<Dim>>::Identity();
    if (general_) inertia(0, 0) *= 0.7;
    bodies.inverse_inertia.push_back(inertia);
  }
  void add_neighbour(int n, const Vec<Dim>& place, const std::array<int, 3>& shift, int side) {
    Vec<Dim> branch = Vec<Dim>::Zero();
    int other = n;
    for (int a = 0, stride = 1; a < Dim; ++a, stride *= side) {
      branch[a] = shift[a];
      if (place[a] + shift[a] < 0 || place[a] + shift[a] >= side) return;
      other += shift[a] * stride;
    }
    // On average, grains touch four of their six neighbours on a triangular lattice, and six of their twelve
    // neighbours on a face-centred cubic lattice.
    const bool is_neighbour = Dim == 2 ? branch.prod() != 1.0 : branch.squaredNorm() == 2.0;
    if (other <= n || !is_neighbour || uniform_(engine_) > (Dim == 2 ? 2.0 / 3.0 : 0.5)) return;
    if constexpr (Dim == 2) branch = Vec<2>(branch[0] + 0.5 * branch[1], std::sqrt(0.75) * branch[1]);
    branch.normalize();
    StepContact<Dim> contact{};
    contact.i = n;
    contact.j = other;
    contact.frame = contact_frame(branch);
    contact.arm_i = 0.5 * branch;
    contact.arm_j = -0.5 * branch;
    contact.branch = branch;
    if (general_) {
      const Vec<Dim> away = 0.15 * Vec<Dim>::NullaryExpr([&] { return normal_(engine_); });
      contact.arm_i += away;
      contact.arm_j += away;
    }
    contact.friction = 0.5;
    step_.contacts.push_back(contact);
  }

  bool general_;
  std::mt19937 engine_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  Step<Dim> step_;
};

template <int Dim, bool General>
void sweeps(benchmark::State& state) {
  Step<Dim> step = LatticeStep<Dim>(General, state.range(1) != 0, static_cast<double>(state.range(2))).step();
  const auto instructions = static_cast<InstructionSet>(state.range(3));
  if (!supported(instructions)) return state.SkipWithError("this processor lacks the instruction set");
  GaussSeidel<Dim> solver(step.bodies, step.contacts, static_cast<int>(state.range(0)), instructions);
  solver.solve(0.0, 100);
  constexpr int kSweeps = 100;
  for (auto _ : state) solver.solve(0.0, kSweeps, 10);
  state.SetItemsProcessed(state.iterations() * kSweeps * static_cast<std::int64_t>(step.contacts.size()));
  int n_open = 0, n_sliding = 0;
  for (const StepContact<Dim>& c : step.contacts) {
    n_open += c.impulse[0] == 0.0;
    n_sliding += c.impulse[0] > 0.0 && c.impulse.template tail<Dim - 1>().norm() > 0.4999999 * c.impulse[0];
  }
  state.counters["contacts"] = static_cast<double>(step.contacts.size());
  state.counters["open"] = n_open;
  state.counters["sliding"] = n_sliding;
  state.counters["residual"] = solver.residual();
}

void arguments(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgsProduct({{1, 2}, {0, 1}, {3000, 10000}, {0, 1, 2}})
      ->ArgNames({"threads", "cell", "grains", "instructions"})
      ->UseRealTime();
}
BENCHMARK(sweeps<2, false>)->Name("sweeps_disks")->Apply(arguments);
BENCHMARK(sweeps<2, true>)->Name("sweeps_2d_general")->Apply(arguments);
BENCHMARK(sweeps<3, false>)->Name("sweeps_spheres")->Apply(arguments);
BENCHMARK(sweeps<3, true>)->Name("sweeps_3d_general")->Apply(arguments);

}  // namespace
}  // namespace floc
