#include "floc/tradeoff/sample_path.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/packing/equilibrium.h"
#include "floc/relaxation/equilibrator.h"

namespace floc {
namespace {

/// Continues the run until equilibrium number end - 1 is reached, and adds its equilibria to `path`. Stops earlier if
/// an equilibrium is not reached or the deadline has passed.
void run_until(Run<2>& run, int end, const Deadline& deadline, SamplePath& path) {
  while (run.point().step < end && path.whole()) {
    switch (run.advance()) {
      case RunEvent::equilibrium:
        path.states.push_back({run.target().stage, run.state(), {}, {}, {}});
        run.saved("");
        break;
      case RunEvent::gave_up:
        path.failure = fmt::format("step {} ({} P = {:.4g}) did not converge: {}", run.point().step,
                                   run.target().branch, run.pressure(), run.report().blocking);
        break;
      case RunEvent::chunk:
        path.out_of_time = deadline.passed();
    }
  }
}

/// Multiplies the caps on the strain rate of the cell by `factor`.
/// @param capped  a CellResponse or RelaxationOptions, which contains the caps
template <class Capped>
void scale_caps(double factor, Capped& capped) {
  if (capped.strain_rate_cap) *capped.strain_rate_cap *= factor;
  if (capped.inertial_number_cap) *capped.inertial_number_cap *= factor;
}

}  // namespace

RunOptions run_options(const Scene& scene, const StudiedSetting& setting, std::uint64_t seed) {
  RunOptions options = scene;
  options.seed = seed;
  options.text.clear();
  setting.numerical.apply(options.relaxation);
  options.relaxation.threads = 1;
  if (setting.n_grains > 0) options.grains.count = setting.n_grains;
  for (LoadStage& stage : options.load) {
    stage.cell.cell_mass = setting.cell_mass_factor * stage.cell.applied_to(options.relaxation).cell_mass;
    scale_caps(setting.rate_cap_factor, stage.cell);
  }
  scale_caps(setting.rate_cap_factor, options.assembly.cell);
  scale_caps(setting.rate_cap_factor, options.relaxation);
  return options;
}

SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline) {
  SamplePath path;
  const double start = processor_seconds();
  Run<2> assembly(options);
  const int n_planned = static_cast<int>(assembly.plan().size());
  std::vector<int> stages;
  for (const PlannedEquilibrium& planned : assembly.plan()) stages.push_back(planned.stage);
  const auto n_assembled = static_cast<int>(std::count(stages.begin(), stages.end(), -1));
  run_until(assembly, reference ? n_assembled : n_planned, deadline, path);
  for (int first = n_assembled; reference && first < n_planned;) {
    const auto last = static_cast<int>(
        std::upper_bound(stages.begin(), stages.end(), stages[static_cast<std::size_t>(first)]) -
        stages.begin());
    const State<2>& from = reference->states[static_cast<std::size_t>(first - 1)].state;
    Run<2> stage(options, point_after(from, ""), from.packing);
    run_until(stage, last, deadline, path);
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
  // Most states are so close to an equilibrium with the strictest settings that Newton steps reach it without motion.
  options.finish = Finish::statics;
  for (ObservedState& s : path.states) {
    s.settled = s.observation;
    if (s.state.residuals.within(strict.tolerance)) continue;
    const auto relaxer = make_equilibrator<2>(options, s.state.packing, s.state.target_stress);
    RelaxationStatus status = RelaxationStatus::running;
    while (status == RelaxationStatus::running && !deadline.passed()) status = relaxer->advance();
    if (status != RelaxationStatus::converged) {
      path.out_of_time = status == RelaxationStatus::running;
      if (!path.out_of_time)
        path.failure =
            fmt::format("state {} did not converge to an equilibrium with the strictest settings: {}",
                        s.state.path.step, relaxer->report().blocking);
      return;
    }
    State<2> settled = s.state;
    settled.packing = relaxer->packing();
    ModuliSequence<2> moduli{ModuliOptions{}};
    s.settled = observe(settled, moduli);
  }
}

}  // namespace floc
