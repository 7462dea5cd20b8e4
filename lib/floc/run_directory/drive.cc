#include "floc/run_directory/drive.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/seconds_since.h"
#include "floc/packing/overlaps.h"

namespace floc {
namespace {

using Clock = std::chrono::steady_clock;

template <int Dim>
class Driver {
 public:
  Driver(Run<Dim>& run, RunDirectory& directory, const DriveOptions<Dim>& options, MotionTable<Dim>* table)
      : run_(run), directory_(directory), options_(options), table_(table) {}

  DriveReport drive() {
    step_began_ = last_checkpoint_ = Clock::now();
    while (!run_.finished() && run_.point().step <= options_.until) {
      const RunEvent event = advance();
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
  /// Advances the run by one chunk of time steps. If the motion cannot continue, no single key of the scene is the
  /// cause; the error message therefore names the step and its pressure.
  RunEvent advance() {
    try {
      return run_.advance();
    } catch (const NoResult& error) {
      throw NoResult(present_step() + ": " + error.what());
    } catch (const InputError& error) {
      throw InputError(
          present_step(),
          fmt::format(
              "the motion of the packing cannot continue: {}. A packing collapses in this way if its contacts "
              "are too soft for its pressure or for its adhesion: expected stiffer contacts, a lower pressure "
              "or less adhesion. floc scene check prints the stiffness number kappa, which compares the "
              "stiffness "
              "with the pressure or the adhesion",
              error.what()));
    }
  }

  /// Names the present step of the run, its branch and its pressure, for messages.
  std::string present_step() const {
    return fmt::format("step {} (branch {}, {})", run_.point().step, run_.target().branch,
                       run_.pressure_text());
  }

  void save() {
    const double seconds = seconds_since(step_began_);
    const State<Dim> state = run_.state();
    require_small_overlaps(fmt::format("step {}, {}", state.path.step, imposed_pressure_text(state)),
                           state.packing);
    directory_.require_held();
    if (table_ != nullptr) table_->finish_step(run_);
    // The table of the motion (contacts.csv or energy.csv) is written before the state file. If the run is killed
    // between the two, the resumed run removes the rows beyond the last saved state. In the opposite order, the resumed
    // run could not restore the missing rows.
    if (table_ != nullptr) table_->write();
    const std::string sha256 = directory_.save(state, options_.timing ? std::optional(seconds) : std::nullopt);
    if (options_.equilibrium) options_.equilibrium(state, run_.report(), seconds);
    run_.saved(sha256);
    step_began_ = Clock::now();
  }

  void checkpoint() {
    directory_.require_held();
    if (table_ != nullptr) table_->write();
    if (!run_.finished()) {
      State<Dim> state = run_.release_state();
      directory_.save_checkpoint(state, run_.point());
      run_.restore_packing(std::move(state.packing));
    }
    last_checkpoint_ = Clock::now();
  }

  /// Stops the run because the packing does not come to equilibrium. The report of the relaxation is taken before the
  /// checkpoint is written, because writing the checkpoint restarts the relaxation.
  DriveReport give_up() { return stop_with({DriveReport::gave_up, run_.report()}); }

  DriveReport stop_with(DriveReport report) {
    checkpoint();
    return report;
  }

  Run<Dim>& run_;
  RunDirectory& directory_;
  const DriveOptions<Dim>& options_;
  MotionTable<Dim>* table_;
  Clock::time_point step_began_, last_checkpoint_;
};

}  // namespace

template <int Dim>
Run<Dim> start_or_resume(RunDirectory& directory, const RunOptions& options) {
  std::optional<ReachedPoint<Dim>> reached = directory.resume_point<Dim>();
  return reached ? Run<Dim>(options, std::move(reached->point), std::move(reached->packing))
                 : Run<Dim>(options);
}

template <int Dim>
DriveReport drive(Run<Dim>& run, RunDirectory& directory, const DriveOptions<Dim>& options,
                  MotionTable<Dim>* table) {
  require_in_range("until", options.until, DriveOptions<Dim>::kUntil);
  return Driver(run, directory, options, table).drive();
}

#define FLOC_INSTANTIATE(Dim)                                               \
  template Run<Dim> start_or_resume<Dim>(RunDirectory&, const RunOptions&); \
  template DriveReport drive(Run<Dim>&, RunDirectory&, const DriveOptions<Dim>&, MotionTable<Dim>*);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
