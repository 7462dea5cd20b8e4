#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "floc/assembly/aggregation.h"
#include "floc/loading/run_options.h"
#include "floc/loading/run_plan.h"
#include "floc/packing/state.h"
#include "floc/relaxation/equilibrator.h"

namespace floc {

/// The state of a run between two chunks: with the options and the packing, all that decides how it goes on.
/// This is what a checkpoint holds.
struct RunPoint {
  int step = 0;                          ///< number of the equilibrium being made
  bool aggregating = false;              ///< grains still collide and stick
  bool shaken = false;                   ///< the vibration before this equilibrium is over
  std::string equilibration;             ///< progress of the equilibrator, empty at the beginning of a step
  double equilibration_time = 0.0;       ///< simulated time of this step so far
  std::int64_t equilibration_steps = 0;  ///< time steps of this step so far
  std::uint64_t stream_state = 0;
  double time = 0.0;         ///< simulated time before this relaxation (time)
  std::int64_t n_steps = 0;  ///< time steps before it
  double aggregation_skin = 0.0;
  std::string parent_sha256;                    ///< of the last saved state
  std::vector<double> last_sides, last_stress;  ///< of the last saved state: where a turn starts
  double last_offset = 0.0;  ///< of the lattice vector of a sheared axis where this step started (length)
  StageReference turn;       ///< to which this step belongs, where axes are loaded differently
};

/// The point after a saved equilibrium: what a run continues from, with the packing of the state, when there is
/// no checkpoint.
/// @param sha256  of the file it was saved in
template <int Dim>
RunPoint point_after(const State<Dim>& state, const std::string& sha256);

/// Outcome of one chunk of a run.
enum class RunEvent {
  chunk,        ///< nothing yet; between two chunks a run may be stopped and continued without a trace
  equilibrium,  ///< `state()` is the next equilibrium; save it, then call `saved()`
  gave_up,      ///< the present step does not converge; `report()` says what blocks
};

/// A whole run: assembly, then every equilibrium of the load path. It never touches a file: its caller saves
/// the states it makes.
template <int Dim>
class Run {
 public:
  /// A run from its beginning. @throws InputError for options that cannot be run.
  explicit Run(RunOptions options);
  /// A run continued from a point inside.
  Run(RunOptions options, RunPoint point, Packing<Dim> packing);

  const std::vector<PlannedEquilibrium>& plan() const { return plan_; }
  bool finished() const { return point_.step == static_cast<int>(plan_.size()); }

  /// Passes the packing to an observer as it moves, with the time since the beginning of the run.
  /// @pre the run stays where it is in memory from now on
  void set_observer(MotionObserver<Dim> observer);

  /// One chunk. @pre not finished, and `saved()` was called after the last equilibrium.
  RunEvent advance();
  /// The equilibrium just reached.
  State<Dim> state() const;
  /// The state as it is now, without a copy: the run releases its packing, and has to get it back by
  /// `restore_packing()` before it is used again.
  State<Dim> release_state();
  void restore_packing(Packing<Dim> packing);
  /// Goes on to the next step. @param sha256 of the file the state was saved in
  void saved(const std::string& sha256);

  const RunPoint& point() const { return point_; }
  const Packing<Dim>& packing() const;
  const PlannedEquilibrium& target() const { return plan_[point_.step]; }
  /// Mean of the stresses on the axes: imposed, or carried where none is imposed.
  double pressure() const;
  /// Progress of the present step.
  RelaxationReport report() const;
  int n_clusters() const { return aggregation_ ? aggregation_->n_clusters() : 1; }

 private:
  void shake_and_start_step();
  void begin_stage();
  LoadTarget<Dim> load() const;
  void start_step();
  void pass_observer();
  double agitation_speed() const;
  PathPosition path() const;
  State<Dim> state_without_packing() const;
  void take_packing_back();

  RunOptions options_;
  std::vector<PlannedEquilibrium> plan_;
  RunPoint point_;
  Packing<Dim> packing_;  ///< while neither of those below has it: a large packing is held once
  std::unique_ptr<Aggregation<Dim>> aggregation_;
  std::unique_ptr<Equilibrator<Dim>> equilibrator_;
  MotionObserver<Dim> observer_;
};

}  // namespace floc
