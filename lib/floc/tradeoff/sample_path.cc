#include "floc/tradeoff/sample_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "floc/base/error.h"
#include "floc/loading/run_plan.h"
#include "floc/packing/equilibrium.h"
#include "floc/relaxation/equilibrator.h"
#include "floc/tradeoff/peak_memory.h"

namespace floc {
namespace {

/// Returns the load of a state on its driven axis: the imposed stress or, for an imposed length or shear, the strain.
template <int Dim>
double driven_load(const State<Dim>& state) {
  if (state.path.turn.is_simple_shear()) return state.path.turn.shear;
  const int axis = state.path.turn.axis;
  if (state.path.turn.empty() || state.target_side[axis] == 0.0)
    return stress_on_driven_axis<Dim>(state, state.target_stress);
  return std::log(state.path.turn.sides[static_cast<std::size_t>(axis)] / state.target_side[axis]);
}

template <int Dim>
ObservedState reached(int stage, State<Dim> state) {
  ObservedState s;
  s.stage = stage;
  s.control = state.path.turn.control;
  s.mean_stress = state.target_stress.mean();
  s.driven_load = driven_load(state);
  s.driven_stress = stress_on_driven_axis<Dim>(state, state.target_stress);
  s.reduced_pressure = reduced_pressure<Dim>(state.packing, s.driven_stress);
  s.test = test_point(state);
  s.start_of_test = start_of_test(state);
  s.state = std::move(state);
  return s;
}

/// Reads a state file of a run and adds its state, without the packing, to `path`.
/// @param stage  number of the stage to which the state belongs; -1 for the assembly
template <int Dim>
void read_into(const std::string& file, int stage, SamplePath& path) {
  AnyState state = read_state(file);
  if (!std::holds_alternative<State<Dim>>(state))
    throw InputError(file, fmt::format("expected a state of {} dimensions, as in the scene of the run", Dim));
  const Observation observation = observe_structure(std::get<State<Dim>>(state));
  path.states.push_back(reached<Dim>(stage, std::get<State<Dim>>(std::move(state))));
  path.states.back().observation = observation;
  path.states.back().state = AnyState{};
}

/// Continues the run and adds its equilibria to `path`, until equilibrium number end - 1 is reached. Stops earlier if
/// an equilibrium is not reached or the deadline has passed.
template <int Dim>
void run_until(Run<Dim>& run, int end, const Deadline& deadline, SamplePath& path) {
  while (run.point().step < end && path.whole()) {
    switch (run.advance()) {
      case RunEvent::equilibrium:
        path.states.push_back(reached<Dim>(run.target().stage, run.state()));
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

/// Runs the assembly and all stages, and adds their equilibria to `path`.
/// @param reference  see make_sample()
template <int Dim>
void run_path(const RunOptions& options, const SamplePath* reference, const Deadline& deadline,
              SamplePath& path) {
  Run<Dim> assembly(options);
  const int n_planned = static_cast<int>(assembly.plan().size());
  std::vector<int> stages;
  for (const PlannedEquilibrium& planned : assembly.plan()) stages.push_back(planned.stage);
  const auto n_assembled = static_cast<int>(std::count(stages.begin(), stages.end(), -1));
  run_until(assembly, reference ? n_assembled : n_planned, deadline, path);
  for (int first = n_assembled; reference && first < n_planned;) {
    const auto last = static_cast<int>(
        std::upper_bound(stages.begin(), stages.end(), stages[static_cast<std::size_t>(first)]) -
        stages.begin());
    const auto& from = std::get<State<Dim>>(reference->states[static_cast<std::size_t>(first - 1)].state);
    Run<Dim> stage(options, point_after(from, ""), from.packing);
    run_until(stage, last, deadline, path);
    first = last;
  }
}

template <int Dim>
void observe_path(const ModuliOptions& moduli, SamplePath& path) {
  ModuliSequence<Dim> sequence(moduli);
  for (ObservedState& s : path.states) {
    const auto& state = std::get<State<Dim>>(s.state);
    s.observation = observe(state, sequence);
    for (const Contact<Dim>& c : state.packing.contacts)
      if (!c.distant) s.touching.emplace_back(c.i, c.j);
  }
}

template <int Dim>
SamplePath sample_of(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                     const Deadline& deadline) {
  SamplePath path;
  const PeakMemory memory;
  const double start = processor_seconds();
  run_path<Dim>(options, reference, deadline, path);
  const double relaxed = processor_seconds();
  observe_path<Dim>(moduli, path);
  path.core_seconds = processor_seconds() - start;
  path.moduli_seconds = processor_seconds() - relaxed;
  path.memory = memory.megabytes();
  return path;
}

/// Sets the member `settled` of one state. @return whether the state has reached equilibrium with the
/// strictest settings
template <int Dim>
bool settle(const RelaxationOptions& strict, const Deadline& deadline, const State<Dim>& state,
            ObservedState& s, SamplePath& path) {
  s.settled = s.observation;
  const bool rigid = state.packing.law.is_rigid();
  if (!rigid && state.residuals.within(strict.tolerance)) return true;
  const auto relaxer = make_equilibrator<Dim>(
      strict, state.packing, LoadTarget<Dim>{state.target_stress, state.target_side, state.target_offset});
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running && !deadline.passed()) status = relaxer->advance();
  if (status != RelaxationStatus::converged) {
    path.out_of_time = status == RelaxationStatus::running;
    if (!path.out_of_time)
      path.failure = fmt::format("state {} did not converge to an equilibrium with the strictest settings: {}",
                                 state.path.step, relaxer->report().blocking);
    return false;
  }
  State<Dim> settled = state;
  settled.packing = relaxer->packing();
  settled.stress = relaxer->stress();
  ModuliSequence<Dim> moduli{ModuliOptions{}};
  s.settled = observe(settled, moduli);
  return true;
}

}  // namespace

void SamplePath::drop_packings() {
  for (ObservedState& s : states) s.state = AnyState{};
}

SamplePath make_sample(const RunOptions& options, const ModuliOptions& moduli, const SamplePath* reference,
                       const Deadline& deadline) {
  return options.dimension == 2 ? sample_of<2>(options, moduli, reference, deadline)
                                : sample_of<3>(options, moduli, reference, deadline);
}

SamplePath read_sample(const Scene& scene, const std::vector<std::string>& files) {
  SamplePath path;
  const auto plan = plan_run(scene.assembly, scene.law, scene.load, scene.dimension);
  for (std::size_t k = 0; k < files.size() && k < plan.size(); ++k)
    scene.dimension == 2 ? read_into<2>(files[k], plan[k].stage, path)
                         : read_into<3>(files[k], plan[k].stage, path);
  return path;
}

void settle(const RelaxationOptions& strict, const Deadline& deadline, SamplePath& path) {
  RelaxationOptions options = strict;
  // In most states, the grains are already very close to equilibrium with the strictest settings. Newton's method then
  // finds this equilibrium without simulated motion.
  options.finish = Finish::statics;
  for (ObservedState& s : path.states)
    if (!std::visit([&](const auto& state) { return settle(options, deadline, state, s, path); }, s.state))
      return;
}

}  // namespace floc
