#include <fmt/format.h>
#include <malloc.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "contact_tracker.h"
#include "floc/base/error.h"
#include "floc/scene/read_scene.h"
#include "run_directory.h"
#include "run_ensemble.h"
#include "run_monitor.h"

namespace floc {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

void interrupt(int) {
  g_interrupted = 1;
}

struct RunArguments {
  std::string scene;
  std::string directory;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::string seeds;
  int jobs = 1;
  std::optional<int> threads;
  std::optional<int> until;
  std::optional<double> track_contacts;  ///< time between two looks
  bool resume = false;
  bool overwrite = false;
};

RunOptions run_options(const Scene& scene, const RunArguments& arguments) {
  RunOptions options = scene;
  if (arguments.seed) options.seed = *arguments.seed;
  if (arguments.threads) options.relaxation.threads = *arguments.threads;
  return options;
}

/// Drives a run and keeps its directory: a state and a row for each equilibrium, a checkpoint now and then.
class RunDriver {
 public:
  RunDriver(Run<2>& run, RunDirectory& directory, ContactTracker* tracker, double checkpoint_every, int until)
      : run_(run),
        directory_(directory),
        tracker_(tracker),
        checkpoint_every_(checkpoint_every),
        until_(until),
        monitor_(static_cast<int>(run.plan().size())) {}

  int drive() {
    step_began_ = last_checkpoint_ = Clock::now();
    while (!run_.finished() && run_.point().step <= until_) {
      const RunEvent event = run_.advance();
      if (event == RunEvent::equilibrium) save();
      if (event == RunEvent::gave_up) return give_up();
      if (event == RunEvent::stretch) monitor_.stretch(run_);
      if (g_interrupted) return stop();
      if (seconds_since(last_checkpoint_) > checkpoint_every_) checkpoint();
    }
    directory_.remove_checkpoint();
    return kDone;
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double seconds_since(Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  }

  void save() {
    const double seconds = seconds_since(step_began_);
    const State<2> state = run_.state();
    if (tracker_ != nullptr) tracker_->finish_step(run_);
    // What leads beyond the states that are saved is forgotten when the run is taken up: the rows go first.
    if (tracker_ != nullptr) tracker_->write();
    const std::string sha256 = directory_.save(state, seconds);
    monitor_.equilibrium(state, run_.report(), seconds);
    run_.saved(sha256);
    step_began_ = Clock::now();
  }

  void checkpoint() {
    if (tracker_ != nullptr) tracker_->write();
    if (!run_.finished()) {
      State<2> state = run_.lend_state();
      directory_.save_checkpoint(state, run_.point());
      run_.go_on(std::move(state.packing));
    }
    last_checkpoint_ = Clock::now();
  }

  int stop() {
    checkpoint();
    fmt::print(stderr, "\ninterrupted; --resume continues from here\n");
    return kInterrupted;
  }

  int give_up() {
    const RelaxationReport report = run_.report();
    checkpoint();
    fmt::print(stderr, "step {} ({} P = {:.4g}) did not converge: {}, falls at {:.2g} per unit time\n",
               run_.point().step, run_.target().branch, run_.target().pressure, report.blocking,
               report.decay_rate);
    return kNotConverged;
  }

  Run<2>& run_;
  RunDirectory& directory_;
  ContactTracker* tracker_;  // null: nobody looks at contacts
  double checkpoint_every_;
  int until_;
  RunMonitor monitor_;
  Clock::time_point step_began_, last_checkpoint_;
};

/// Has the contacts of a run recorded while it moves.
std::unique_ptr<ContactTracker> track_contacts(Run<2>& run, const RunOptions& options,
                                               const RunDirectory& directory, double interval) {
  const int step = run.point().step;
  Packing<2> start = step > 0 ? directory.start_of(step) : Run<2>(options).packing();
  auto tracker = std::make_unique<ContactTracker>(directory.contact_table(), run, std::move(start));
  run.observe({interval, [&run, watcher = tracker.get()](const Packing<2>& packing, double time) {
                 watcher->see(run, packing, time);
               }});
  return tracker;
}

/// Smallest block that goes back to the system when it is freed, where glibc would keep those up to 32 MB: lists, states and
/// files of a large packing follow each other, and need not be held together.
constexpr int kReturnedBlock = 1 << 22;

int run_scene(const RunArguments& arguments) {
  ::mallopt(M_MMAP_THRESHOLD, kReturnedBlock);
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  const RunOptions options = run_options(scene, arguments);
  const Existing existing = arguments.resume      ? Existing::resume
                            : arguments.overwrite ? Existing::overwrite
                                                  : Existing::refuse;
  const std::vector<PlannedEquilibrium> plan = plan_run(options.assembly, options.law, options.load);
  RunDirectory directory(arguments.directory, existing, options);
  std::optional<ReachedPoint> reached = directory.resume_point();
  Run<2> run =
      reached ? Run<2>(options, std::move(reached->point), std::move(reached->packing)) : Run<2>(options);

  std::unique_ptr<ContactTracker> tracker;
  if (arguments.track_contacts && !run.finished())
    tracker = track_contacts(run, options, directory, *arguments.track_contacts);

  if (!scene.start.empty()) fmt::print(stderr, "start: {}\n", scene.start);
  if (!scene.accuracy.empty()) fmt::print(stderr, "accuracy: {}\n", scene.accuracy);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  const int code = RunDriver(run, directory, tracker.get(), scene.checkpoint_every,
                             arguments.until.value_or(std::numeric_limits<int>::max()))
                       .drive();
  if (code == kDone)
    fmt::print(stderr,
               "{} equilibria in {}. Next:\n  floc moduli {}/state-*.h5\n  floc fit consolidation {}\n"
               "  floc verify {}/state-*.h5\n",
               run.point().step, arguments.directory, arguments.directory, arguments.directory,
               arguments.directory);
  return code;
}

/// One process a seed, each a run of this scene with these arguments.
int run_seeds(const RunArguments& arguments) {
  const SeedRange seeds = parse_seeds(arguments.seeds);
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  (void)plan_run(scene.assembly, scene.law, scene.load);  // a bad path is told once, before any sample starts
  if (!scene.is_random())
    throw InputError("--seeds " + arguments.seeds,
                     "all samples would be the same: the scene starts from a state at rest; expected "
                     "assembly.agitation, or one run");
  const std::string& directory = arguments.directory;
  const bool used = std::filesystem::exists(directory) && !std::filesystem::is_empty(directory);
  if (used && !arguments.resume && !arguments.overwrite)
    throw InputError(directory,
                     "is not empty: give --resume to continue the runs in it or --overwrite to replace them");
  std::vector<std::string> words = {arguments.scene};
  for (const std::string& change : arguments.overrides) words.insert(words.end(), {"--set", change});
  if (arguments.threads) words.insert(words.end(), {"--threads", std::to_string(*arguments.threads)});
  if (arguments.until) words.insert(words.end(), {"--until", std::to_string(*arguments.until)});
  if (arguments.track_contacts)
    words.insert(words.end(), {"--track-contacts", fmt::format("{}", *arguments.track_contacts)});
  if (arguments.resume) words.emplace_back("--resume");
  if (arguments.overwrite) words.emplace_back("--overwrite");
  return run_ensemble(directory, seeds, arguments.jobs, words, arguments.resume);
}

}  // namespace

Command add_run(CommandLine program) {
  CommandLine app = program.add_subcommand("run", "Assemble, equilibrate and load a packing as a scene says");
  auto arguments = std::make_shared<RunArguments>();
  app.add_option("scene", arguments->scene, "Scene file (TOML)").required();
  app.add_option("-o,--output", arguments->directory, "Directory for states, path.csv and checkpoints")
      .required();
  const Option resume = app.add_flag("--resume", arguments->resume,
                                     "Continue the run in the directory (harmless on a first run)");
  app.add_flag("--overwrite", arguments->overwrite, "Replace the run in the directory").excludes(resume);
  const Option seed =
      app.add_option("--seed", arguments->seed, "Seed of the random numbers, instead of run.seed");
  const Option seeds = app.add_option("--seeds", arguments->seeds,
                                      "A..B: an ensemble, one sample a seed in a directory seed-N of its own")
                           .excludes(seed);
  app.add_option("--jobs", arguments->jobs, "Samples that run at the same time").needs(seeds).between(1, 1024);
  app.add_option("--threads", arguments->threads, "Threads; results are the same for any number")
      .between(1, 1024);
  app.add_option("--set", arguments->overrides,
                 "KEY=VALUE: change one key of the scene, e.g. contact.rolling.coefficient=0.5")
      .one_argument_each();
  app.add_option(
         "--track-contacts", arguments->track_contacts,
         "record in DIR/contacts.csv which contacts open and close inside steps, looking each DT of simulated "
         "time (at least each 500 time steps)")
      .positive();
  app.add_option("--until", arguments->until, "Stop after the equilibrium of this number").non_negative();
  return {app,
          [arguments] { return arguments->seeds.empty() ? run_scene(*arguments) : run_seeds(*arguments); }};
}

}  // namespace floc
