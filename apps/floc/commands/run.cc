#include <fmt/format.h>
#include <malloc.h>

#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "commands/next_steps.h"
#include "commands/run_ensemble.h"
#include "commands/run_monitor.h"
#include "floc/base/error.h"
#include "floc/run_directory/scene_run.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_warnings.h"
#include "process/command.h"

namespace floc {
namespace {

struct RunArguments {
  std::string scene;
  std::vector<std::string> overrides;
  SceneRunOptions run;
  std::string seeds;  ///< "A..B"; empty: one run
  int jobs = 1;
};

constexpr WholeRange kJobs{.least = 1, .most = 1024};

volatile std::sig_atomic_t g_interrupted = 0;

void interrupt(int) {
  g_interrupted = 1;
}

/// Prints how a run ended. @return exit code
template <int Dim>
int report_outcome(const DriveReport& report, const Run<Dim>& run, const std::string& directory) {
  switch (report.outcome) {
    case DriveReport::stopped:
      fmt::print(stderr, "\n{}\n", ending_of(report, run));
      return kInterrupted;
    case DriveReport::gave_up:
      fmt::print(stderr, "{}\n", ending_of(report, run));
      return kNotConverged;
    case DriveReport::done:
      break;
  }
  fmt::print(stderr, "{} in {}. Next:\n{}",
             run.point().step == 1 ? "1 equilibrium" : fmt::format("{} equilibria", run.point().step),
             directory, next_steps(directory, "state-*.h5"));
  return kDone;
}

/// Size of the smallest block of memory that is returned to the system when it is freed (bytes). glibc would keep
/// blocks of up to 32 MB, so that the lists, states and files of a large packing would occupy memory at the same time.
constexpr int kReturnedBlock = 1 << 22;

template <int Dim>
int run_scene(const Scene& scene, const SceneRunOptions& asked) {
  // From here on a signal has to leave the directory of the run in a consistent state.
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  SceneRun<Dim> scene_run(scene, asked);

  if (!scene.start.empty()) fmt::print(stderr, "start: {}\n", scene.start);
  if (!scene.accuracy.empty()) fmt::print(stderr, "accuracy: {}\n", scene.accuracy);
  RunMonitor monitor(static_cast<int>(scene_run.run.plan().size()));
  DriveOptions<Dim> watch;
  watch.stop = [] { return g_interrupted != 0; };
  watch.chunk = [&monitor](const Run<Dim>& moving) { monitor.chunk(moving); };
  watch.equilibrium = [&monitor](const auto&... reached) { monitor.equilibrium(reached...); };
  return report_outcome(scene_run.drive(watch), scene_run.run, asked.directory);
}

void tell_unused_threads(const Scene& scene, const SceneRunOptions& asked) {
  if (const std::string words = unused_threads(scene, asked); !words.empty()) fmt::print(stderr, "{}\n", words);
}

int run_scene(const RunArguments& arguments) {
  ::mallopt(M_MMAP_THRESHOLD, kReturnedBlock);
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  for (const std::string& warning : scene_warnings(scene))
    fmt::print(stderr, "{}: warning: {}\n", arguments.scene, warning);
  tell_unused_threads(scene, arguments.run);
  return scene.dimension == 3 ? run_scene<3>(scene, arguments.run) : run_scene<2>(scene, arguments.run);
}

/// Runs one process per seed, each with this scene and these arguments.
int run_seeds(const RunArguments& arguments) {
  const SeedRange seeds = parse_seeds(arguments.seeds);
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  // Faults that all samples share are reported once, before any of them starts.
  const RunOptions options = checked_options(scene, arguments.run);
  if (!scene.is_random())
    throw InputError("--seeds " + arguments.seeds,
                     "all samples would be the same, because the scene starts from a state at rest; expected "
                     "assembly.agitation, or one run");
  const std::string& directory = arguments.run.directory;
  const ClaimedDirectory claim(directory, existing_of(arguments.run), "runs");
  tell_unused_threads(scene, arguments.run);
  std::vector<std::string> args = {arguments.scene};
  for (const std::string& change : arguments.overrides) args.insert(args.end(), {"--set", change});
  // The number of threads that are of use, so that no sample repeats the remark that more are not.
  args.insert(args.end(), {"--threads", std::to_string(options.relaxation.threads)});
  if (arguments.run.until) args.insert(args.end(), {"--until", std::to_string(*arguments.run.until)});
  if (arguments.run.track_contacts)
    args.insert(args.end(), {"--track-contacts", fmt::format("{}", *arguments.run.track_contacts)});
  if (arguments.run.track_energy) args.emplace_back("--track-energy");
  if (arguments.run.resume) args.emplace_back("--resume");
  if (arguments.run.overwrite) args.emplace_back("--overwrite");
  if (arguments.run.no_timing) args.emplace_back("--no-timing");
  return run_ensemble(claim, directory, seeds, arguments.jobs, args, arguments.run.resume);
}

}  // namespace

Command add_run(CommandLine program) {
  CommandLine app =
      program.add_subcommand("run", "Assemble a packing, bring it to equilibrium and load it as a scene says");
  auto arguments = std::make_shared<RunArguments>();
  app.add_option("SCENE", arguments->scene, "scene file (TOML)").required();
  app.add_option("-o,--output", arguments->run.directory, "directory for states, path.csv and checkpoints")
      .required();
  // Without --resume or --overwrite a directory that holds a run is rejected.
  const Option resume = app.add_flag("--resume", arguments->run.resume,
                                     "continue the run in the directory (harmless on a first run)");
  app.add_flag("--overwrite", arguments->run.overwrite, "replace the run in the directory").excludes(resume);
  const Option seed =
      app.add_option("--seed", arguments->run.seed, "seed of the random numbers, instead of run.seed");
  // Every sample of an ensemble has a seed of its own, so --seed does not apply to it.
  const Option seeds =
      app.add_option("--seeds", arguments->seeds,
                     "A..B: an ensemble with one sample per seed, each in its own directory seed-N")
          .excludes(seed);
  app.add_option("--jobs", arguments->jobs, "samples that run at the same time").needs(seeds).within(kJobs);
  app.add_option(
         "--threads", arguments->run.threads,
         "number of threads, of which at most one for each 1400 disks or 500 spheres is used; results do not "
         "depend on it")
      .within(RunOptions::kThreads);
  app.add_option("--set", arguments->overrides,
                 "KEY=VALUE: change one key of the scene, e.g. contact.rolling.coefficient=0.5")
      .one_argument_each();
  const Option track_contacts =
      app.add_option("--track-contacts", arguments->run.track_contacts,
                     "record in DIR/contacts.csv which contacts open and close inside steps, checking every DT "
                     "of simulated time (at least every 500 time steps)")
          .positive();
  app.add_flag(
         "--track-energy", arguments->run.track_energy,
         "record the energy account in DIR/energy.csv: the work of the boundary, the energy stored, and the "
         "energy lost to each cause; needs equilibrium.finish = \"dynamic\", and takes about 20 times as long")
      .excludes(track_contacts);
  app.add_flag("--no-timing", arguments->run.no_timing,
               "leave the column seconds of path.csv empty, so that equal runs are equal files");
  app.add_option("--until", arguments->run.until, "stop after the equilibrium with this number").non_negative();
  return {app,
          [arguments] { return arguments->seeds.empty() ? run_scene(*arguments) : run_seeds(*arguments); }};
}

}  // namespace floc
