#include "floc/study/sample_path.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/packing/equilibrium.h"
#include "floc/relaxation/equilibrator.h"

namespace floc {
namespace {

/// Index of the stage that makes each equilibrium of a plan, -1 for those of the assembly.
std::vector<int> stage_of_steps(const RunOptions& options, std::size_t n_planned) {
  std::vector<int> of_loading;
  double from = options.assembly.pressure;
  for (int t = 0; t < static_cast<int>(options.load.size()); ++t) {
    of_loading.insert(of_loading.end(), stage_pressures(from, options.load[t]).size(), t);
    from = options.load[t].to;
  }
  std::vector<int> stages(n_planned - of_loading.size(), -1);
  stages.insert(stages.end(), of_loading.begin(), of_loading.end());
  return stages;
}

/// Runs until the equilibrium of number `end` is made; the states go to `path`.
void run_until(Run<2>& run, int end, const std::vector<int>& stages, const Deadline& deadline,
               SamplePath& path) {
  while (run.point().step < end && path.whole()) {
    switch (run.advance()) {
      case RunEvent::equilibrium:
        path.states.push_back({stages[static_cast<std::size_t>(run.point().step)], run.state(), {}, {}, {}});
        run.saved("");
        break;
      case RunEvent::gave_up:
        path.failure = fmt::format("step {} ({} P = {:.4g}) did not converge: {}", run.point().step,
                                   run.target().branch, run.target().pressure, run.report().blocking);
        break;
      case RunEvent::chunk:
        path.out_of_time = deadline.passed();
    }
  }
}

}  // namespace

RunOptions run_options(const Scene& scene, const StudiedSetting& setting, std::uint64_t seed) {
  RunOptions options = scene;
  options.seed = seed;
  options.text.clear();
  setting.numerical.apply(options.relaxation);
  options.relaxation.threads = 1;
  if (setting.n_grains > 0) options.grains.count = setting.n_grains;
  if (options.relaxation.strain_rate_cap) *options.relaxation.strain_rate_cap *= setting.rate_cap_factor;
  if (options.relaxation.inertial_number_cap)
    *options.relaxation.inertial_number_cap *= setting.rate_cap_factor;
  return options;
}

SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline) {
  SamplePath path;
  const double start = processor_seconds();
  Run<2> assembly(options);
  const int n_planned = static_cast<int>(assembly.plan().size());
  const std::vector<int> stages = stage_of_steps(options, assembly.plan().size());
  const auto n_assembled = static_cast<int>(std::count(stages.begin(), stages.end(), -1));
  run_until(assembly, reference ? n_assembled : n_planned, stages, deadline, path);
  for (int first = n_assembled; reference && first < n_planned;) {
    const auto last = static_cast<int>(
        std::upper_bound(stages.begin(), stages.end(), stages[static_cast<std::size_t>(first)]) -
        stages.begin());
    const State<2>& from = reference->states[static_cast<std::size_t>(first - 1)].state;
    Run<2> stage(options, point_after(from.path, from.provenance.stream_state, ""), from.packing);
    run_until(stage, last, stages, deadline, path);
    first = last;
  }
  const double relaxed = processor_seconds();
  ModuliSequence<2> sequence(moduli);
  for (ObservedState& s : path.states) {
    s.observation = observe(s.state, sequence);
    for (const Contact<2>& c : s.state.packing.contacts)
      if (!c.distant) s.touching.emplace_back(c.i, c.j);
  }
  path.core_seconds = processor_seconds() - start;
  path.moduli_seconds = processor_seconds() - relaxed;
  return path;
}

void settle(const RelaxationOptions& strict, const Deadline& deadline, SamplePath& path) {
  RelaxationOptions options = strict;
  options.finish = Finish::statics;  // most states are so near that no motion is needed
  for (ObservedState& s : path.states) {
    s.settled = s.observation;
    if (s.state.residuals.within(strict.tolerance)) continue;
    const auto relaxer = make_equilibrator<2>(options, s.state.packing, s.state.target_stress);
    RelaxationStatus status = RelaxationStatus::running;
    while (status == RelaxationStatus::running && !deadline.passed()) status = relaxer->advance();
    if (status != RelaxationStatus::converged) {
      path.out_of_time = status == RelaxationStatus::running;
      if (!path.out_of_time)
        path.failure = fmt::format("state {} finds no strict equilibrium: {}", s.state.path.step,
                                   relaxer->report().blocking);
      return;
    }
    State<2> settled = s.state;
    settled.packing = relaxer->packing();
    ModuliSequence<2> moduli{ModuliOptions{}};
    s.settled = observe(settled, moduli);
  }
}

}  // namespace floc
