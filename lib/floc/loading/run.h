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

/// State of a run between two chunks. Together with the options and the packing it determines how the run
/// continues. Checkpoints hold it.
struct RunPoint {
  int step = 0;                          ///< number of the equilibrium being made
  bool aggregating = false;              ///< the aggregation of grains is not finished
  bool shaken = false;                   ///< the vibration before this equilibrium is over
  std::string equilibration;             ///< progress of the equilibrator, empty at the beginning of a step
  double equilibration_time = 0.0;       ///< simulated time of this step so far
  std::int64_t equilibration_steps = 0;  ///< time steps of this step so far
  std::uint64_t stream_state = 0;
  double time = 0.0;         ///< simulated time before this relaxation (time)
  std::int64_t n_steps = 0;  ///< time steps before it
  double aggregation_skin = 0.0;
  std::string parent_sha256;  ///< hash of the file of the last saved state
  std::vector<double> last_sides,
      last_stress;           ///< sides and stresses of the last saved state, from which a stage starts
  double last_offset = 0.0;  ///< offset of the sheared lattice vector at the start of this step (length)
  StageReference turn;       ///< stage of this step, where axes are loaded differently
};

/// Point of a run after a saved equilibrium. With the packing of the state, a run continues from it when there
/// is no checkpoint.
/// @param sha256  of the file that the state was saved in
template <int Dim>
RunPoint point_after(const State<Dim>& state, const std::string& sha256);

/// Outcome of one chunk of a run.
enum class RunEvent {
  chunk,        ///< no equilibrium yet; a run stopped here and continued gives the same results
  equilibrium,  ///< `state()` is the next equilibrium; save it, then call `saved()`
  gave_up,      ///< the present step does not converge; `report()` gives the reason
};

/// A whole run: assembly, then every equilibrium of the load path. It writes no files: the caller saves the
/// states.
template <int Dim>
class Run {
 public:
  /// Starts a run from its beginning. @throws InputError for options that cannot be run.
  explicit Run(RunOptions options);
  /// Continues a run from a point (checkpoint or point_after()) with the packing at that point.
  Run(RunOptions options, RunPoint point, Packing<Dim> packing);

  const std::vector<PlannedEquilibrium>& plan() const { return plan_; }
  bool finished() const { return point_.step == static_cast<int>(plan_.size()); }

  /// Sets an observer of the packing as it moves. It gets the time since the beginning of the run.
  /// @pre this object is not moved or copied afterwards
  void set_observer(MotionObserver<Dim> observer);

  /// Advances by one chunk. @pre the run is not finished, and `saved()` was called after the last equilibrium.
  RunEvent advance();
  /// State as it is now, with a copy of the packing; after RunEvent::equilibrium, the equilibrium.
  State<Dim> state() const;
  /// State as it is now, without a copy of the packing. The run gives its packing away and has to get it back
  /// by `restore_packing()` before it is used again.
  State<Dim> release_state();
  void restore_packing(Packing<Dim> packing);
  /// Starts the next step.
  /// @param sha256  of the file that the state was saved in
  void saved(const std::string& sha256);

  const RunPoint& point() const { return point_; }
  const Packing<Dim>& packing() const;
  const PlannedEquilibrium& target() const { return plan_[point_.step]; }
  /// Mean of the stresses on the axes, imposed or carried where none is imposed (force/length^(Dim-1)).
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
  Packing<Dim> packing_;  ///< empty while an object below holds it, so that a large packing is held once
  std::unique_ptr<Aggregation<Dim>> aggregation_;
  std::unique_ptr<Equilibrator<Dim>> equilibrator_;
  MotionObserver<Dim> observer_;
};

}  // namespace floc
