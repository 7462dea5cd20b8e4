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
#include "process/prices_option.h"

namespace floc {
namespace {

struct RunArguments {
  std::string scene;
  std::vector<std::string> overrides;
  std::string prices;
  SceneRunOptions run;
  std::string seeds;  ///< range of seeds "A..B" of an ensemble; empty for a single run
  int jobs = 1;
};

constexpr WholeRange kJobs{.least = 1, .most = 1024};

volatile std::sig_atomic_t g_interrupted = 0;

void interrupt(int) {
  g_interrupted = 1;
}

/// Prints the outcome of a run and the commands that a user may run next. @return exit code of floc
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
  fmt::print(stderr, "The run has reached {}; its files are in the directory {}. You may run next:\n{}",
             run.point().step == 1 ? "1 state" : fmt::format("{} states", run.point().step), directory,
             next_steps(directory, "state-*.h5"));
  return kDone;
}

/// Smallest size (bytes) of a freed block of memory that is returned to the system at once. By default glibc keeps
/// freed blocks of up to 32 MB. In a run of a large packing, the memory of freed neighbour lists, saved states and
/// files would then add up.
constexpr int kReturnedBlock = 1 << 22;

template <int Dim>
int run_scene(const Scene& scene, const SceneRunOptions& asked) {
  // From here on, SIGINT and SIGTERM do not end the process at once, so that the run can first complete the files in
  // its directory.
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  SceneRun<Dim> scene_run(scene, asked);

  if (!scene.start.empty()) fmt::print(stderr, "starting state: {}\n", scene.start);
  if (!scene.accuracy.empty())
    fmt::print(stderr, "numerical settings chosen for the accuracy that the scene requires: {}\n",
               scene.accuracy);
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
  const Scene scene = read_scene(arguments.scene, arguments.overrides, arguments.prices);
  for (const std::string& warning : scene_warnings(scene))
    fmt::print(stderr, "{}: warning: {}\n", arguments.scene, warning);
  tell_unused_threads(scene, arguments.run);
  return scene.dimension == 3 ? run_scene<3>(scene, arguments.run) : run_scene<2>(scene, arguments.run);
}

/// Runs an ensemble: one process per seed, each with the same scene and arguments.
int run_seeds(const RunArguments& arguments) {
  const SeedRange seeds = parse_seeds(arguments.seeds);
  const Scene scene = read_scene(arguments.scene, arguments.overrides, arguments.prices);
  // Faults of the options would stop every sample. They are reported here once, before any sample starts.
  const RunOptions options = checked_options(scene, arguments.run);
  if (!scene.is_random())
    throw InputError("--seeds " + arguments.seeds,
                     "all samples would be equal, because the scene starts from a saved state at rest, without "
                     "random velocities: set assembly.agitation in the scene, or omit --seeds");
  const std::string& directory = arguments.run.directory;
  const ClaimedDirectory claim(directory, existing_of(arguments.run), "runs");
  tell_unused_threads(scene, arguments.run);
  std::vector<std::string> args = {arguments.scene};
  for (const std::string& change : arguments.overrides) args.insert(args.end(), {"--set", change});
  if (!arguments.prices.empty()) args.insert(args.end(), {"--prices", arguments.prices});
  // Each sample is told the number of threads that it can use. Otherwise each sample would print the message of
  // tell_unused_threads() again.
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
  CommandLine app = program.add_subcommand(
      "run", "Assemble a packing, bring it to equilibrium and load it as described in a scene file");
  auto arguments = std::make_shared<RunArguments>();
  app.add_option("SCENE", arguments->scene, "scene file (TOML)").required();
  app.add_option("-o,--output", arguments->run.directory,
                 "directory for the state files, the table path.csv and the checkpoint of the run")
      .required();
  // If neither --resume nor --overwrite is given, floc run rejects an output directory that already contains a run.
  const Option resume =
      app.add_flag("--resume", arguments->run.resume,
                   "continue the run in the output directory, or start a new run if there is none");
  app.add_flag("--overwrite", arguments->run.overwrite, "replace the run in the output directory")
      .excludes(resume);
  const Option seed =
      app.add_option("--seed", arguments->run.seed,
                     "seed of the random numbers, used instead of the key run.seed of the scene");
  // The option --seed excludes --seeds, because every sample of an ensemble has its own seed.
  const Option seeds = app.add_option("--seeds", arguments->seeds,
                                      "A..B: run an ensemble with one sample for each seed from A to B, each "
                                      "in its own subdirectory seed-N")
                           .excludes(seed);
  app.add_option("--jobs", arguments->jobs,
                 "largest number of samples of the ensemble that run at the same time")
      .needs(seeds)
      .within(kJobs);
  app.add_option("--threads", arguments->run.threads,
                 "number of threads; at most one thread per 1400 disks or 500 spheres is used, and the results "
                 "do not depend on the number of threads")
      .within(RunOptions::kThreads);
  app.add_option("--set", arguments->overrides,
                 "KEY=VALUE: set one key of the scene to another value, e.g. contact.rolling.coefficient=0.5")
      .one_argument_each();
  add_prices_option(app, arguments->prices);
  const Option track_contacts =
      app.add_option("--track-contacts", arguments->run.track_contacts,
                     "DT: write to DIR/contacts.csv which contacts open and close during each step of the load "
                     "path; contacts are checked once per simulated time DT, and at least every 500 time steps")
          .positive();
  app.add_flag("--track-energy", arguments->run.track_energy,
               "write the energy balance to DIR/energy.csv: work of the boundary, stored energy, and energy "
               "dissipated by each mechanism; requires equilibrium.finish = \"dynamic\" in the scene and makes "
               "the run about 20 times longer")
      .excludes(track_contacts);
  app.add_flag("--no-timing", arguments->run.no_timing,
               "leave the column seconds of path.csv empty, so that identical runs write identical files");
  app.add_option("--until", arguments->run.until, "stop the run after the equilibrium state with this number")
      .non_negative();
  return {app,
          [arguments] { return arguments->seeds.empty() ? run_scene(*arguments) : run_seeds(*arguments); }};
}

}  // namespace floc
