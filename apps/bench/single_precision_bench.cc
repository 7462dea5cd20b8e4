// Benchmark that compares a force loop in single precision with the present loop in double precision. The results are
// nanoseconds per pair of grains, for disks with adhesion and friction (data/scenes/type2_no_rolling.toml) and for
// glass beads. Both loops go through the same pairs of the same packing, whose grains do not move:
//   floc_bench --benchmark_filter=precision

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "floc/assembly/gas.h"
#include "floc/contact/law_parameters.h"
#include "floc/contact/law_table.h"
#include "floc/neighbors/space_order.h"
#include "floc/packing/tile.h"
#include "floc/relaxation/interaction.h"
#include "floc/relaxation/pair_arrays.h"
#include "floc/relaxation/relaxer.h"
#include "floc/relaxation/row_sums.h"
#include "single_precision_pairs.h"
#include "step_bench.h"

namespace floc {
namespace {

using Floats = AlignedVector<float>;

template <int Dim>
LawParameters law_of_trial() {
  LawParameters law;
  if constexpr (Dim == 2) {
    law.normal = LinearRepulsion{1e5};
    law.adhesion = TailAdhesion{1.0, 1e-3};
    law.damping = ViscousDamping{0.015, DampingMass::effective};
    law.friction = CoulombFriction{0.5, 1e5};
  } else {
    law.normal = HertzRepulsion{0.91, 0.3};
    law.damping = CriticalDamping{0.98};
    law.friction = MindlinFriction{0.3};
  }
  return law;
}

/// Returns a packing whose grains have small velocities: 1400 disks under the pressure P = 10 F0/a (F0: pull-off force,
/// a: largest diameter), or 4000 glass beads at the stiffness number kappa = 8395.
template <int Dim>
const Packing<Dim>& packing_of_trial() {
  static const Packing<Dim> made = [] {
    GrainOptions grains;
    grains.count = Dim == 2 ? 1400 : 500;
    grains.diameter.min = Dim == 2 ? 0.5 : 1.0;
    grains.diameter.max = 1.0;
    RandomStream random(1, 1);
    RelaxationOptions options;
    options.inertial_number_cap = 0.03;
    Relaxer<Dim> relaxer(options, make_gas<Dim>(grains, law_of_trial<Dim>(), Dim == 2 ? 0.36 : 0.45, random),
                         Vec<Dim>::Constant(Dim == 2 ? 10.0 : std::pow(8395.0, -1.5)));
    while (relaxer.advance() == RelaxationStatus::running) continue;
    Packing<Dim> packing = relaxer.packing();
    if constexpr (Dim == 3) packing = tiled<3>(packing, {2, 2, 2});
    const double speed = Dim == 2 ? 1e-3 : 1e-6;
    for (Vec<Dim>& v : packing.grains.velocity)
      for (int a = 0; a < Dim; ++a) v[a] = speed * (random.uniform() - 0.5);
    return packing;
  }();
  return made;
}

/// The grains and pairs of one packing, in the formats of both loops.
template <int Dim>
class Trial {
 public:
  explicit Trial(const Packing<Dim>& packing)
      : law_{compose_law(packing.law)},
        in_kernel_(kernel_law<Dim>(law_.any, Partner::grain)),
        grains_(packing.grains, space_order(packing.cell, packing.grains)),
        x_list_(grains_.x),
        inverse_skin_squared_(grains_.x[0].size(), 0.0) {
    const int n_blocks = grains_.n_blocks();
    Grains<Dim> ordered = Grains<Dim>::with_size(grains_.size());
    grains_.copy_positions_to(ordered);
    std::copy_n(grains_.radius.begin(), grains_.size(), ordered.radius.begin());
    pairs_ = PairArrays<Dim>(find_pairs(packing.cell, ordered, 0.01), Partner::grain, grains_, law_, kTimeStep,
                             n_blocks);
    row_sums_ =
        RowSums<Dim>({&pairs_}, row_kind<Dim>(law_), grains_.size(), SweepPlan(pairs_, n_blocks, 1, n_blocks));
    for (int a = 0; a < Dim; ++a) cell_.lattice[a][a] = packing.cell.matrix(a, a);
    cell_.slip_time = kTimeStep;
    view_ = pairs_.view();
    view_.row = row_sums_.rows_of_group(0);
    take_floats();
  }

  int n_pairs() const { return pairs_.size(); }
  void in_double(InstructionSet set) {
    step_kernels<Dim>(set, LatticeShape::rectangular, in_kernel_.index())
        .compute_pairs(address_of_alternative(in_kernel_), grains_.view(x_list_, inverse_skin_squared_), view_,
                       0, pairs_.size(), cell_);
  }
  void in_single(SingleLoop<Dim> loop) {
    loop(address_of_alternative(in_kernel_), single_, 0, static_cast<int>(i_.size()), cell_);
  }
  /// Returns the largest difference between the forces of the two loops, divided by the largest force.
  double difference() const {
    const int size = Dim == 2 ? 4 : 8;
    double largest = 0.0, error = 0.0;
    for (int p = 0; p < pairs_.size(); ++p)
      for (int a = 0; a < Dim; ++a) {
        const double f = view_.row[size * p + a];
        largest = std::max(largest, std::abs(f));
        error = std::max(error, std::abs(f - single_.row[size * p + a]));
      }
    return error / largest;
  }

 private:
  static constexpr double kTimeStep = Dim == 2 ? 4e-4 : 1e-2;

  /// Copies the data that the loop in single precision reads. Each array of pairs is padded to a multiple of 16 floats
  /// with copies of its last pair; the copies do not interact.
  void take_floats() {
    const std::size_t n = (static_cast<std::size_t>(pairs_.size()) + 15) / 16 * 16;
    const auto floats = [&](const auto* from, std::size_t size, std::size_t given) -> const float* {
      Floats& to = kept_.emplace_back(size);
      for (std::size_t k = 0; k < size; ++k) to[k] = static_cast<float>(from[std::min(k, given - 1)]);
      return to.data();
    };
    const auto given = static_cast<std::size_t>(pairs_.size());
    kept_.reserve(40);
    const auto of_pairs = [&](const auto* from) { return floats(from, n, given); };
    const auto numbers = [&](const double* from) -> const float* {
      if (from == nullptr) return nullptr;
      return view_.own_numbers == 0 ? floats(from, 16, 1) : of_pairs(from);
    };
    for (std::size_t k = 0; k < n; ++k) {
      i_.push_back(view_.i[std::min(k, given - 1)]);
      j_.push_back(view_.j[std::min(k, given - 1)]);
      radii_.push_back(view_.radii[std::min(k, given - 1) & view_.own_numbers]);
    }
    single_ = {};
    single_.i = i_.data();
    single_.j = j_.data();
    single_.own_numbers = view_.own_numbers;
    single_.radii = radii_.data();
    single_.radii_float = numbers(view_.radii);
    single_.share_i = numbers(view_.share_i);
    single_.damping = numbers(view_.damping);
    single_.reduced_radius = numbers(view_.reduced_radius);
    single_.reduced_mass = numbers(view_.reduced_mass);
    const auto of_grains = [&](const auto& from) { return floats(from.data(), from.size(), from.size()); };
    for (int a = 0; a < Dim; ++a) {
      single_.image[a] = of_pairs(view_.image[a]);
      single_.x[a] = grains_.x[a].data();
      single_.v[a] = of_grains(grains_.v[a]);
    }
    for (int a = 0; a < kRotations<Dim>; ++a) single_.spin[a] = of_grains(grains_.spin[a]);
    const auto zeros = [&](std::size_t size) { return kept_.emplace_back(size, 0.0f).data(); };
    single_.viscous = zeros(n);
    for (float*& history : single_.history) history = zeros(n);
    single_.row = zeros(n * (Dim == 2 ? 4 : 8));
  }

  ComposedLaw law_;
  AnyKernelLaw<Dim> in_kernel_;
  GrainArrays<Dim> grains_;
  std::array<typename GrainArrays<Dim>::Component, Dim> x_list_;
  typename GrainArrays<Dim>::Component inverse_skin_squared_;
  PairArrays<Dim> pairs_;
  RowSums<Dim> row_sums_;
  PairCell<Dim> cell_{};
  PairView<Dim> view_{};
  std::vector<Floats> kept_;
  AlignedVector<int> i_, j_;
  AlignedVector<double> radii_;
  SinglePairs<Dim> single_;
};

template <int Dim>
SingleLoop<Dim> single_loop(InstructionSet set) {
  const bool wide = set == InstructionSet::avx512;
  if constexpr (Dim == 2)
    return wide ? single_disks_avx512() : single_disks_avx2();
  else
    return wide ? single_spheres_avx512() : single_spheres_avx2();
}

template <int Dim>
void precision(benchmark::State& state) {
  const auto set = static_cast<InstructionSet>(state.range(0));
  if (!supported(set)) return state.SkipWithError("this processor does not support these instructions");
  Trial<Dim> trial(packing_of_trial<Dim>());
  double seconds[2] = {};
  const auto clocked = [&](double& total, const auto& loop) {
    const std::clock_t start = std::clock();
    for (int k = 0; k < 200; ++k) loop();
    total += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / 200;
  };
  trial.in_double(set);
  trial.in_single(single_loop<Dim>(set));
  state.counters["difference"] = trial.difference();
  for (auto _ : state) {
    clocked(seconds[0], [&] { trial.in_double(set); });
    clocked(seconds[1], [&] { trial.in_single(single_loop<Dim>(set)); });
  }
  const double pairs = static_cast<double>(trial.n_pairs()) * static_cast<double>(state.iterations());
  state.counters["double_ns"] = 1e9 * seconds[0] / pairs;
  state.counters["single_ns"] = 1e9 * seconds[1] / pairs;
  state.counters["gain"] = seconds[0] / seconds[1];
}
BENCHMARK(precision<2>)->ArgName("instructions")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK(precision<3>)->ArgName("instructions")->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace floc
