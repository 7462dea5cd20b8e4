#include "floc/run/drive.h"

#include <chrono>
#include <optional>
#include <utility>

namespace floc {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point since) {
  return std::chrono::duration<double>(Clock::now() - since).count();
}

class Driver {
 public:
  Driver(Run<2>& run, RunDirectory& directory, const DriveOptions& options, ContactTracker* tracker)
      : run_(run), directory_(directory), options_(options), tracker_(tracker) {}

  DriveReport drive() {
    step_began_ = last_checkpoint_ = Clock::now();
    while (!run_.finished() && run_.point().step <= options_.until) {
      const RunEvent event = run_.advance();
      if (event == RunEvent::equilibrium) save();
      if (event == RunEvent::gave_up) return give_up();
      if (event == RunEvent::chunk && options_.chunk) options_.chunk(run_);
      if (options_.stop && options_.stop()) return stop_with({DriveReport::stopped, {}});
      if (seconds_since(last_checkpoint_) > options_.checkpoint_every) checkpoint();
    }
    directory_.remove_checkpoint();
    return {};
  }

 private:
  void save() {
    const double seconds = seconds_since(step_began_);
    const State<2> state = run_.state();
    if (tracker_ != nullptr) tracker_->finish_step(run_);
    // What leads beyond the states that are saved is forgotten when the run is taken up: the rows go first.
    if (tracker_ != nullptr) tracker_->write();
    const std::string sha256 = directory_.save(state, seconds);
    if (options_.equilibrium) options_.equilibrium(state, run_.report(), seconds);
    run_.saved(sha256);
    step_began_ = Clock::now();
  }

  void checkpoint() {
    if (tracker_ != nullptr) tracker_->write();
    if (!run_.finished()) {
      State<2> state = run_.release_state();
      directory_.save_checkpoint(state, run_.point());
      run_.restore_packing(std::move(state.packing));
    }
    last_checkpoint_ = Clock::now();
  }

  /// A checkpoint takes the step up anew, so what blocks it is asked before.
  DriveReport give_up() { return stop_with({DriveReport::gave_up, run_.report()}); }

  DriveReport stop_with(DriveReport report) {
    checkpoint();
    return report;
  }

  Run<2>& run_;
  RunDirectory& directory_;
  const DriveOptions& options_;
  ContactTracker* tracker_;
  Clock::time_point step_began_, last_checkpoint_;
};

}  // namespace

Run<2> start_or_resume(RunDirectory& directory, const RunOptions& options) {
  std::optional<ReachedPoint> reached = directory.resume_point();
  return reached ? Run<2>(options, std::move(reached->point), std::move(reached->packing)) : Run<2>(options);
}

DriveReport drive(Run<2>& run, RunDirectory& directory, const DriveOptions& options, ContactTracker* tracker) {
  return Driver(run, directory, options, tracker).drive();
}

}  // namespace floc
