#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "floc/loading/run_plan.h"
#include "floc/neighbors/spread_liquid.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/overlaps.h"
#include "floc/relaxation/relaxer.h"
#include "floc/scene/read_scene.h"
#include "floc/structure/energy_account.h"
#include "support/dynamics.h"
#include "support/places.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Inputs of an energy account: laws, grains and pressure. All scenes with these inputs are listed in one entry.
struct LawPath {
  std::vector<std::string> scenes;
  GrainOptions grains;  ///< grains of the scenes, but fewer
  int dimension = 2;
  std::vector<Law> laws;  ///< laws of the path, in order
  double pressure = 0.0;  ///< largest imposed pressure
};

LawPath law_path_of(const Scene& scene) {
  LawPath path;
  path.scenes = {scene.name};
  path.dimension = scene.dimension;
  path.grains = scene.grains;
  path.grains.count = scene.dimension == 2 ? 40 : 30;
  if (path.grains.diameter.kind == DiameterDistribution::Kind::list)
    path.grains.diameter.kind = DiameterDistribution::Kind::uniform;
  for (const PlannedEquilibrium& e : plan_run(scene.assembly, scene.law, scene.load, scene.dimension)) {
    if (path.laws.empty() || path.laws.back() != e.law) path.laws.push_back(e.law);
    if (e.is_isotropic()) path.pressure = std::max(path.pressure, e.pressure);
  }
  return path;
}

/// Returns the law paths of all shipped scenes in periodic cells, without duplicates.
std::vector<LawPath> shipped_law_paths() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(test::source_directory() + "/data/scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<LawPath> paths;
  for (const std::string& file : files) {
    const Scene scene = read_scene(file);
    if (scene.assembly.box || scene.law.is_rigid()) continue;  // boxes and rigid grains have no energy account
    LawPath path = law_path_of(scene);
    const auto same = std::find_if(paths.begin(), paths.end(), [&](const LawPath& other) {
      return other.laws == path.laws && other.dimension == path.dimension && other.pressure == path.pressure;
    });
    if (same == paths.end())
      paths.push_back(std::move(path));
    else
      same->scenes.push_back(scene.name);
  }
  return paths;
}

/// Returns a gas under the first law of a path, compressed into a dense packing that still moves.
template <int Dim>
Packing<Dim> pressed_packing(const LawPath& path, std::uint64_t seed) {
  RandomStream random(seed, 1);
  Packing<Dim> packing = make_gas<Dim>(path.grains, path.laws.front(), Dim == 2 ? 0.6 : 0.45, random);
  const Vec<Dim> stress = Vec<Dim>::Constant(path.pressure);
  const double unit = inertial_time(packing, stress);
  const auto control = BoundaryControl<Dim>::normal_stress(stress, 0.1 * test::total_mass(packing), 0.1 / unit);
  constexpr int kSteps = 500;
  for (double time = 0.0; time < 20.0 * unit;) {
    const double step = time_step_of(packing, RelaxationOptions{}.time_step, path.pressure);
    const auto dynamics = make_dynamics(packing, control, {step, 0.1 * path.grains.diameter.max});
    dynamics->advance(kSteps, Motion::free);
    packing = dynamics->packing();
    time += kSteps * step;
  }
  return packing;
}

/// Returns random strain rates of such a size that the packing deforms by about its mean overlap within `time`.
template <int Dim>
BoundaryControl<Dim> straining(double overlap, double size, double time, RandomStream& random) {
  BoundaryControl<Dim> control = BoundaryControl<Dim>::fixed();
  for (int k = 0; k < kSymmetric<Dim>; ++k)
    control.target[k] = (random.uniform() - (k < Dim ? 0.3 : 0.5)) * 2.0 * overlap / size / time;
  return control;
}

/// Returns a load that adds half of the pressure to the present stress on each axis.
template <int Dim>
BoundaryControl<Dim> pressing(const Packing<Dim>& packing, double pressure) {
  const Vec<Dim> carried = static_stress(packing).diagonal();
  return BoundaryControl<Dim>::normal_stress(carried + Vec<Dim>::Constant(0.5 * pressure),
                                             0.1 * test::total_mass(packing));
}

/// Returns the energy account of a packing that is loaded under all laws of a path, one after the other. Under each
/// law, strain rates are imposed first, then stresses.
/// @param share  time step divided by that of runs
template <int Dim>
EnergyTerms account_of(const LawPath& path, Packing<Dim> packing, std::uint64_t seed, double share) {
  constexpr double kCoarsest = 0.2;
  const int n_coarse = std::max(60, 400 / static_cast<int>(path.laws.size()));
  const double size = path.grains.diameter.max;
  RandomStream random(seed, 2);
  const double overlap = measure_overlaps(packing).mean * 0.5 * path.grains.diameter.min;
  EnergyAccount<Dim> account(packing);
  for (const Law& law : path.laws) {
    if (packing.law != law) {
      packing.law = law;
      refresh_contacts(packing);
      spread_liquid(packing);
      account.change_law(law);
    }
    for (const bool strains : {true, false}) {
      const double whole = time_step_of(packing, RelaxationOptions{}.time_step, path.pressure);
      const double time = n_coarse * kCoarsest * whole;
      const BoundaryControl<Dim> control =
          strains ? straining<Dim>(overlap, size, time, random) : pressing(packing, path.pressure);
      const auto dynamics = make_dynamics(packing, control, {share * whole, 0.1 * size});
      const int n_steps = static_cast<int>(std::lround(n_coarse * kCoarsest / share));
      for (int k = 0; k < n_steps; ++k) {
        dynamics->advance(1, Motion::free);
        account.advance(dynamics->packing(), share * whole);
      }
      packing = dynamics->packing();
    }
  }
  return account.terms();
}

/// Returns the sum of the magnitudes of all energies that the motion gained or lost.
double throughput(const EnergyTerms& t) {
  return std::abs(t.work) + t.viscous + t.sliding + t.scaling;
}

/// Returns the error of the energy balance divided by the throughput, averaged over the samples, for time steps of 0.2,
/// 0.1 and 0.05 times the time step of runs.
/// @param last  receives the energy terms of the last sample
template <int Dim>
std::array<double, 3> errors_of(const LawPath& path, EnergyTerms& last) {
  constexpr int kSamples = 2;
  std::array<double, 3> errors{};
  for (std::uint64_t seed = 1; seed <= kSamples; ++seed) {
    const Packing<Dim> start = pressed_packing<Dim>(path, seed);
    for (std::size_t k = 0; k < errors.size(); ++k) {
      last = account_of<Dim>(path, start, seed, 0.2 / std::pow(2.0, static_cast<double>(k)));
      errors[k] += std::abs(last.error()) / throughput(last) / kSamples;
    }
  }
  return errors;
}

/// Under the laws of every shipped scene, including changes of laws and added liquid, the error of the energy
/// account is of first order in the time step.
TEST(EnergyOfShippedScenes, ClosesWithTheTimeStep) {
  std::cout << "scenes: laws; error over throughput at steps of 0.2, 0.1 and 0.05 of those of runs, order; "
               "work, viscous, sliding, scaling, liquid, law\n";
  std::size_t n_scenes = 0;
  for (const LawPath& path : shipped_law_paths()) {
    n_scenes += path.scenes.size();
    EnergyTerms t;
    const std::array<double, 3> errors = path.dimension == 3 ? errors_of<3>(path, t) : errors_of<2>(path, t);
    const double order = 0.5 * std::log2(errors[0] / errors[2]);
    const std::string names = fmt::format("{}", fmt::join(path.scenes, ", "));
    std::cout << fmt::format(
        "{}: {}; {:.2e} {:.2e} {:.2e}, {:.2f}; {:.2e} {:.2e} {:.2e} {:.2e} {:.2e} {:.2e}\n", names,
        path.laws.size(), errors[0], errors[1], errors[2], order, t.work, t.viscous, t.sliding, t.scaling,
        t.liquid, t.law);
    EXPECT_LT(errors[2], 0.01) << names;
    EXPECT_GT(order, 0.7) << names;
    const auto modulus = [&](const Law& law) { return law.contact_modulus(path.dimension, 1.0); };
    if (modulus(path.laws.front()) != modulus(path.laws.back())) {
      EXPECT_NE(t.law, 0.0) << names;
    }
    EXPECT_EQ(t.liquid != 0.0, path.laws.back().liquid() != nullptr) << names;
  }
  EXPECT_GT(n_scenes, 20u);
}

}  // namespace
}  // namespace floc
