#include "scene_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>

#include "floc/base/error.h"
#include "floc/relaxation/useful_threads.h"
#include "floc/run/contact_tracker.h"
#include "floc/run/energy_tracker.h"
#include "floc/scene/scene_changes.h"

namespace floc {
namespace {

int threads_asked_for(const Scene& scene, const RunArguments& arguments) {
  return arguments.threads.value_or(scene.relaxation.threads);
}

RunOptions run_options(const Scene& scene, const RunArguments& arguments) {
  RunOptions options = scene;
  if (arguments.seed) options.seed = *arguments.seed;
  options.relaxation.threads =
      useful_threads(scene.grains.count, scene.dimension, threads_asked_for(scene, arguments));
  return options;
}

/// The scene of a run in a directory: of its first state, or of a checkpoint before that; empty without either.
std::string scene_of_run(const std::string& directory) {
  for (const std::string& file : {state_file(directory, 0), directory + "/checkpoint/checkpoint.h5"})
    if (std::filesystem::exists(file))
      return std::visit([](const auto& state) { return state.scene; }, read_state(file));
  return "";
}

/// Opens the directory of the run. What keeps it from being continued is named by its keys.
RunDirectory open_directory(const RunArguments& arguments, Existing existing, const RunOptions& options) {
  try {
    return RunDirectory(arguments.directory, existing, options);
  } catch (const InputError& error) {
    const std::string begun = existing == Existing::resume ? scene_of_run(arguments.directory) : "";
    if (begun.empty() || begun == options.text) throw;
    const std::vector<std::string> changes = scene_changes(options.text, "here", begun, "there");
    throw InputError("", fmt::format("{}; {}", error.what(),
                                     changes.empty() ? "the scenes differ only in comments or layout"
                                                     : fmt::format("changed: {}", fmt::join(changes, "; "))));
  }
}

/// How a force residual that is above its tolerance changes, in words; empty otherwise.
std::string trend_of(const RelaxationReport& report) {
  if (report.decay_rate == 0.0) return "";
  return fmt::format(", {} at {:.2g} per unit time", report.decay_rate > 0.0 ? "falls" : "grows",
                     std::abs(report.decay_rate));
}

}  // namespace

RunOptions checked_options(const Scene& scene, const RunArguments& arguments) {
  if (scene.assembly.box && arguments.track_contacts)
    throw InputError("--track-contacts",
                     "the grains stand in a [box]; contacts are tracked in periodic cells only");
  RunOptions options = run_options(scene, arguments);
  if (arguments.track_energy) require_energy_account(options);
  (void)plan_run(options.assembly, options.law, options.load, options.dimension);
  return options;
}

std::string unused_threads(const Scene& scene, const RunArguments& arguments) {
  return unused_threads(scene.grains.count, scene.dimension, threads_asked_for(scene, arguments));
}

Existing existing_of(const RunArguments& arguments) {
  return arguments.resume ? Existing::resume : arguments.overwrite ? Existing::overwrite : Existing::refuse;
}

template <int Dim>
SceneRun<Dim>::SceneRun(const Scene& scene, const RunArguments& arguments)
    : options(checked_options(scene, arguments)),
      directory(open_directory(arguments, existing_of(arguments), options)),
      run(start_or_resume<Dim>(directory, options)),
      checkpoint_every_(scene.checkpoint_every),
      until_(arguments.until),
      timing_(!arguments.no_timing) {
  if (arguments.track_contacts && !run.finished())
    table = track_contacts(run, options, directory, *arguments.track_contacts);
  if (arguments.track_energy && !run.finished()) table = track_energy(run, options, directory);
}

template <int Dim>
DriveReport SceneRun<Dim>::drive(DriveOptions<Dim> watch) {
  watch.checkpoint_every = checkpoint_every_;
  if (until_) watch.until = *until_;
  watch.timing = timing_;
  return floc::drive(run, directory, watch, table.get());
}

template <int Dim>
std::string ending_of(const DriveReport& report, const Run<Dim>& run) {
  switch (report.outcome) {
    case DriveReport::stopped:
      return "interrupted; --resume continues from here";
    case DriveReport::gave_up:
      if (!run.packing().walls.empty())
        return fmt::format("step {} ({} P = {:.4g}) ended without a state: {}", run.point().step,
                           run.target().branch, run.pressure(), report.relaxation.blocking);
      return fmt::format("step {} ({} P = {:.4g}) did not converge: {}{}", run.point().step,
                         run.target().branch, run.pressure(), report.relaxation.blocking,
                         trend_of(report.relaxation));
    case DriveReport::done:
      break;
  }
  return "";
}

template struct SceneRun<2>;
template struct SceneRun<3>;
template std::string ending_of(const DriveReport&, const Run<2>&);
template std::string ending_of(const DriveReport&, const Run<3>&);

}  // namespace floc
