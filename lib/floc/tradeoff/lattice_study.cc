#include "floc/tradeoff/lattice_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "floc/base/error.h"
#include "floc/lattice/cemented_sample.h"
#include "floc/lattice/grain_forces.h"
#include "floc/lattice/irregular_lattice.h"
#include "floc/lattice/lattice_solution.h"
#include "floc/lattice/node_stress.h"
#include "floc/packing/grain_sizes.h"
#include "floc/tradeoff/peak_memory.h"

namespace floc {
namespace {

/// Largest fraction of the processor time of the study that may be spent on making samples.
constexpr double kShareOfSamples = 0.97;

/// Returns the lattice that `floc lattice` makes by default for the cell of a packing, with the given spacing (length).
Lattice<2> lattice_in(const Cell<2>& cell, double spacing) {
  return triangular_lattice_in(cell, spacing);
}

Lattice<3> lattice_in(const Cell<3>& cell, double spacing) {
  IrregularLatticeOptions options;
  options.spacing = spacing;
  return irregular_lattice(cell, options);
}

/// Returns the stress along the last axis at the nodes of the network.
/// @param phase  phase of the nodes to include (grain or matrix); if absent, all nodes
template <int Dim>
std::vector<double> axial_stresses(const CementedSample<Dim>& sample, const LatticeNetwork<Dim>& network,
                                   const std::vector<Mat<Dim>>& stress, std::optional<Phase> phase) {
  std::vector<double> values;
  for (int k = 0; k < network.n_nodes; ++k)
    if (network.present[k] && (!phase || sample.phase[k] == *phase))
      values.push_back(stress[k](Dim - 1, Dim - 1));
  return values;
}

double tail_rate(const std::vector<double>& values) {
  return stress_distribution(values, 1.0).loaded_1.beta.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Cements the grains of a packing, loads its lattice by a stress of 1 along the last axis, and returns the observables
/// of the lattice.
/// @throws InputError if the lattice cannot be made or cannot carry the load
template <int Dim>
Observation observe_lattice(const Packing<Dim>& packing, const LatticeStudyOptions& options,
                            const LatticeSettings& settings) {
  const double spacing = mean_diameter(packing.grains.radius) / settings.nodes_a_diameter;
  CementOptions cement_options;
  cement_options.matrix_content = options.matrix_content;
  const CementedSample<Dim> sample = cement(packing, lattice_in(packing.cell, spacing), cement_options);
  ElementStiffness stiffness;
  stiffness.grain = options.stiffness_ratio;
  // With one spring constant for all elements in 3D, the modulus of the lattice would be inversely proportional to the
  // spacing of the nodes.
  stiffness.by_facet = Dim == 3;
  const LatticeNetwork<Dim> network = lattice_network(sample, stiffness);
  if (network.n_directions < Dim)
    throw InputError("lattice", "the cemented grains are not connected across the cell");
  RelaxationSettings relaxation;
  relaxation.method = settings.method;
  relaxation.tolerance = settings.tolerance;
  LatticeSolver<Dim> solver(network, relaxation);
  const LatticeSolution<Dim> solution = solver.solve(LatticeLoad<Dim>::uniaxial(Dim - 1, 1.0));
  if (!solution.report.holds || !solution.report.converged)
    throw InputError("lattice", "the solution of the lattice has not converged");
  const std::vector<Mat<Dim>> stress = node_stress(sample.lattice, network, solution);
  std::vector<double> forces;
  for (const GrainForce<Dim>& f : grain_forces(sample, network, solution)) forces.push_back(f.normal);
  Observation x;
  x.fill(std::numeric_limits<double>::quiet_NaN());
  x[kLatticeE] = solution.stress[Dim - 1] / solution.strain[Dim - 1];
  x[kLatticeSpread] = stress_distribution(axial_stresses(sample, network, stress, {}), 1.0).spread;
  x[kTailGrain] = tail_rate(axial_stresses(sample, network, stress, Phase::grain));
  x[kTailMatrix] = tail_rate(axial_stresses(sample, network, stress, Phase::matrix));
  x[kTailForces] = tail_rate(forces);
  return x;
}

template <int Dim>
class LatticeStudy {
 public:
  LatticeStudy(Scene scene, const LatticeStudyOptions& lattice, const TradeoffOptions& options)
      : scene_(std::move(scene)),
        lattice_(lattice),
        options_(options),
        deadline_(kShareOfSamples * options.budget),
        max_samples_(number_of_samples(scene_, options, left_out_)),
        settings_(lattice_settings(scene_)) {
    keep_parameters(options.parameters, settings_);
    paths_.resize(settings_.size());
  }

  Tradeoff run() {
    for (int k = 0; k < max_samples_ && next_sample_fits(k); ++k) run_seed(k);
    Tradeoff out;
    out.n_grains = scene_.grains.count;
    if (!paths_[0].empty()) measure(out);
    out.left_out = left_out_;
    return out;
  }

 private:
  bool next_sample_fits(int k) {
    if (k == 0 || seconds_of_seed_ < deadline_.left()) return true;
    left_out_.push_back(
        fmt::format("all samples after the first {} of {}, because the next sample would take {:.0f} s, but "
                    "only {:.0f} s of the budget are left",
                    k, max_samples_, seconds_of_seed_, std::max(0.0, deadline_.left())));
    return false;
  }

  void run_seed(int k) {
    const Deadline start(0.0);
    const std::uint64_t seed = scene_.seed + static_cast<std::uint64_t>(k);
    // The key is a number of grains, and the value is the path of the scene with this number of grains.
    std::map<int, SamplePath> packings;
    for (std::size_t i = 0; i < settings_.size(); ++i) {
      if (skipped_.contains(i)) continue;
      if (deadline_.passed()) {
        left_out_.push_back(fmt::format("{}, seed {}: the budget was used up", name_of(i), seed));
        if (i == 0) return;
        continue;
      }
      const int n_grains = settings_[i].n_grains;
      if (!packings.contains(n_grains))
        packings[n_grains] = make_sample(run_options(scene_, settings_[i], seed), {}, nullptr, deadline_);
      const SamplePath& packing = packings[n_grains];
      SamplePath path;
      path.failure =
          packing.out_of_time ? "the budget was used up while the packing was made" : packing.failure;
      if (packing.whole()) path = lattice_path(i, std::get<State<Dim>>(packing.states.back().state));
      if (!path.whole() || !path.failure.empty()) {
        left_out_.push_back(fmt::format("{}, seed {}: {}", name_of(i), seed, path.failure));
        if (i == 0) return;
        skipped_.insert(i);
        continue;
      }
      path.states.front().settled =
          i == 0 ? path.states.front().observation : paths_[0][k].states.front().observation;
      options_.progress(
          fmt::format("seed {}, setting {}: this sample took {:.2f} s", seed, name_of(i), path.core_seconds));
      paths_[i][k] = std::move(path);
    }
    seconds_of_seed_ = -start.left();
  }

  std::string name_of(std::size_t i) const { return settings_[i].parameter + " " + settings_[i].value; }

  SamplePath lattice_path(std::size_t i, const State<Dim>& state) const {
    SamplePath path;
    const PeakMemory memory;
    const double start = processor_seconds();
    try {
      ObservedState s;
      s.observation = observe_lattice(state.packing, lattice_, *settings_[i].lattice);
      path.states.push_back(std::move(s));
    } catch (const InputError& reason) {
      path.failure = reason.what();
    }
    path.core_seconds = processor_seconds() - start;
    path.memory = memory.megabytes();
    return path;
  }

  void measure(Tradeoff& out) const {
    std::vector<const SamplePath*> all;
    for (const auto& [k, path] : paths_[0]) all.push_back(&path);
    describe_reference(all, std::nullopt, out);
    for (std::size_t i = 0; i < settings_.size(); ++i) {
      std::vector<const SamplePath*> references, paths;
      for (const auto& [k, path] : paths_[i]) {
        references.push_back(&paths_[0].at(k));
        paths.push_back(&path);
      }
      if (paths.empty()) continue;
      MeasuredSetting m = cost_of(scene_, settings_[i], references, paths);
      m.errors = settings_[i].has_other_states() ? compare_means(references, paths, std::nullopt)
                                                 : compare(references, paths, std::nullopt);
      out.settings.push_back(std::move(m));
    }
    add_sample_numbers(scene_, settings_[0], all, std::nullopt, out);
  }

  Scene scene_;
  LatticeStudyOptions lattice_;
  const TradeoffOptions& options_;
  Deadline deadline_;
  std::vector<std::string> left_out_;
  int max_samples_;
  std::vector<StudiedSetting> settings_;
  // for each setting, the path of each sample; the key is the number of the sample
  std::vector<std::map<int, SamplePath>> paths_;
  std::set<std::size_t> skipped_;
  double seconds_of_seed_ = 0.0;
};

}  // namespace

Tradeoff study_lattice(Scene scene, const LatticeStudyOptions& lattice, const TradeoffOptions& options) {
  require_study(options);
  require_in_range("matrix content", lattice.matrix_content, CementOptions::kContent);
  require_in_range("stiffness ratio", lattice.stiffness_ratio, LatticeStudyOptions::kRatio);
  if (scene.law.is_rigid() || scene.assembly.box)
    throw InputError("--lattice",
                     "cemented grains are studied in packings of elastic disks or spheres in a periodic cell");
  return scene.dimension == 2 ? LatticeStudy<2>(std::move(scene), lattice, options).run()
                              : LatticeStudy<3>(std::move(scene), lattice, options).run();
}

}  // namespace floc
