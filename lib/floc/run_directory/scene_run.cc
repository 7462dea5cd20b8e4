#include "floc/run_directory/scene_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <type_traits>

#include "floc/base/error.h"
#include "floc/relaxation/useful_threads.h"
#include "floc/run_directory/contact_tracker.h"
#include "floc/run_directory/energy_tracker.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_changes.h"

namespace floc {
namespace {

int threads_asked_for(const Scene& scene, const SceneRunOptions& asked) {
  return asked.threads.value_or(scene.relaxation.threads);
}

RunOptions run_options(const Scene& scene, const SceneRunOptions& asked) {
  RunOptions options = scene;
  if (asked.seed) options.seed = *asked.seed;
  options.relaxation.threads =
      useful_threads(scene.grains.count, scene.dimension, threads_asked_for(scene, asked));
  return options;
}

/// Returns the text of the scene of the run in a directory. The text is read from the first state of the run or, as
/// long as there is no state, from the checkpoint. The result is empty if neither exists.
std::string scene_of_run(const std::string& directory) {
  for (const std::string& file : {state_file(directory, 0), directory + "/checkpoint/checkpoint.h5"})
    if (std::filesystem::exists(file))
      return std::visit([](const auto& state) { return state.scene; }, read_state(file));
  return "";
}

/// Opens the directory of a run. If the directory contains the run of another scene, the error message also names the
/// keys in which the two scenes differ.
RunDirectory open_directory(const SceneRunOptions& asked, Existing existing, const RunOptions& options) {
  try {
    return RunDirectory(asked.directory, existing, options);
  } catch (const InputError& error) {
    const std::string begun = existing == Existing::resume ? scene_of_run(asked.directory) : "";
    if (begun.empty() || begun == options.text) throw;
    const std::vector<std::string> changes = scene_changes(options.text, "here", begun, "there");
    throw InputError(
        "", fmt::format("{}; {}", error.what(),
                        changes.empty() ? "the two scenes differ only in comments or layout"
                                        : fmt::format("these values differ: {}", fmt::join(changes, "; "))));
  }
}

/// Returns a text about a packing that has not come to equilibrium: the rate at which its force residual falls or
/// grows. The text is empty if the rate is not known.
std::string trend_of(const RelaxationReport& report) {
  if (report.decay_rate == 0.0) return "";
  return fmt::format(", {} at the rate {:.2g} per unit of time", report.decay_rate > 0.0 ? "falls" : "grows",
                     std::abs(report.decay_rate));
}

}  // namespace

RunOptions checked_options(const Scene& scene, const SceneRunOptions& asked) {
  if (scene.assembly.box && asked.track_contacts)
    throw InputError("--track-contacts",
                     "the scene has walls (table [box]), but contacts are tracked only in periodic cells");
  if (asked.track_contacts && asked.track_energy)
    throw InputError("--track-contacts",
                     "contacts and energies are not tracked in the same run: expected --track-contacts or "
                     "--track-energy");
  RunOptions options = run_options(scene, asked);
  if (asked.track_energy) require_energy_account(options);
  (void)plan_run(options.assembly, options.law, options.load, options.dimension);
  return options;
}

std::string unused_threads(const Scene& scene, const SceneRunOptions& asked) {
  return unused_threads(scene.grains.count, scene.dimension, threads_asked_for(scene, asked));
}

Existing existing_of(const SceneRunOptions& asked) {
  return asked.resume ? Existing::resume : asked.overwrite ? Existing::overwrite : Existing::refuse;
}

template <int Dim>
SceneRun<Dim>::SceneRun(const Scene& scene, const SceneRunOptions& asked)
    : options(checked_options(scene, asked)),
      directory(open_directory(asked, existing_of(asked), options)),
      run(start_or_resume<Dim>(directory, options)),
      checkpoint_every_(scene.checkpoint_every),
      until_(asked.until),
      timing_(!asked.no_timing) {
  // A finished run makes no more time steps, so there is nothing to record. track_contacts() and track_energy() require
  // a run that is not finished.
  if (asked.track_contacts && !run.finished())
    table = track_contacts(run, options, directory, *asked.track_contacts);
  if (asked.track_energy && !run.finished()) table = track_energy(run, options, directory);
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
      return "the run was interrupted; --resume continues it from here";
    case DriveReport::gave_up:
      if (!run.packing().walls.empty())
        return fmt::format("step {} (branch {}, {}) ended without an equilibrium: {}", run.point().step,
                           run.target().branch, run.pressure_text(), report.relaxation.blocking);
      return fmt::format("step {} (branch {}, {}) did not converge: {}{}", run.point().step,
                         run.target().branch, run.pressure_text(), report.relaxation.blocking,
                         trend_of(report.relaxation));
    case DriveReport::done:
      break;
  }
  return "";
}

DriveReport run_scene(const std::string& scene_file, const SceneRunOptions& asked,
                      const std::vector<std::string>& changes, const std::function<bool()>& stop) {
  const Scene scene = read_scene(scene_file, changes);
  const auto driven = [&]<int Dim>(std::integral_constant<int, Dim>) {
    DriveOptions<Dim> watch;
    if (stop) watch.stop = stop;
    return SceneRun<Dim>(scene, asked).drive(watch);
  };
  return scene.dimension == 3 ? driven(std::integral_constant<int, 3>{})
                              : driven(std::integral_constant<int, 2>{});
}

template struct SceneRun<2>;
template struct SceneRun<3>;
template std::string ending_of(const DriveReport&, const Run<2>&);
template std::string ending_of(const DriveReport&, const Run<3>&);

}  // namespace floc
