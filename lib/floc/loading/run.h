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

/// Progress of a run between two chunks of time steps. Together with the options and the packing it determines how the
/// run continues. It is stored in checkpoints.
struct RunPoint {
  int step = 0;               ///< number of the equilibrium that is being computed
  bool aggregating = false;   ///< whether the aggregation of grains is still going on
  bool shaken = false;        ///< whether the vibration before this equilibrium has been done
  std::string equilibration;  ///< progress of the relaxation of this step, as text; empty at its beginning
  double equilibration_time = 0.0;       ///< simulated time of this step so far (time unit of the scene)
  std::int64_t equilibration_steps = 0;  ///< number of time steps of this step of the load path so far
  std::uint64_t stream_state = 0;        ///< state of the random stream
  double time = 0.0;                     ///< simulated time before this relaxation (time unit of the scene)
  std::int64_t n_steps = 0;              ///< number of time steps before this relaxation
  double aggregation_skin = 0.0;  ///< margin (Verlet skin) of the neighbour lists in the aggregation (length)
  std::string parent_sha256;      ///< SHA-256 of the file of the last saved state
  std::vector<double> last_sides,
      last_stress;           ///< sides and stresses of the last saved state, from which a stage starts
  double last_offset = 0.0;  ///< offset of the sheared lattice vector at the start of this step (length)
  StageReference turn;       ///< stage to which this step belongs, if its axes are loaded differently
};

/// Returns the progress of a run after a saved equilibrium. With the packing of the state, a run can continue from it
/// without a checkpoint.
/// @param sha256  SHA-256 of the file in which the state was saved
template <int Dim>
RunPoint point_after(const State<Dim>& state, const std::string& sha256);

/// Outcome of advancing a run by one chunk of time steps.
enum class RunEvent {
  chunk,        ///< no equilibrium yet; a run that is stopped here and continued gives identical results
  equilibrium,  ///< `state()` is the next equilibrium; save it, then call `saved()`
  gave_up,  ///< the present step of the load path does not converge to an equilibrium; `report()` gives the reason
};

/// A whole run: the assembly, then every equilibrium of the load path. This class writes no files; the caller has to
/// save the states.
template <int Dim>
class Run {
 public:
  /// Starts a run from its beginning. @throws InputError if the options are invalid
  explicit Run(RunOptions options);
  /// Continues a run from a point, which a checkpoint or point_after() gives, with the packing at this point.
  Run(RunOptions options, RunPoint point, Packing<Dim> packing);

  const std::vector<PlannedEquilibrium>& plan() const { return plan_; }
  bool finished() const { return point_.step == static_cast<int>(plan_.size()); }

  /// Sets a function that is called with the packing as it moves, and with the time since the beginning of the run.
  /// @pre this object is not moved or copied afterwards
  void set_observer(MotionObserver<Dim> observer);

  /// Advances the run by one chunk of time steps. @pre the run is not finished, and `saved()` was called after the last
  /// equilibrium
  RunEvent advance();
  /// Returns the present state, with a copy of the packing. After RunEvent::equilibrium it is the equilibrium.
  State<Dim> state() const;
  /// Returns the present state with the packing itself, without copying it. The packing must be given back by
  /// `restore_packing()` before the run is used again.
  State<Dim> release_state();
  void restore_packing(Packing<Dim> packing);
  /// Starts the next step, after the caller has saved the state.
  /// @param sha256  SHA-256 of the file in which the state was saved
  void saved(const std::string& sha256);

  const RunPoint& point() const { return point_; }
  const Packing<Dim>& packing() const;
  const PlannedEquilibrium& target() const { return plan_[point_.step]; }
  /// Returns the mean of the stresses on the axes (force/length^(Dim-1)). On an axis without an imposed stress, the
  /// stress that it carries is taken.
  double pressure() const;
  /// Returns a report on the progress of the present step of the load path.
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
  /// packing; empty while aggregation_ or equilibrator_ holds it, so that it is in memory only once
  Packing<Dim> packing_;
  std::unique_ptr<Aggregation<Dim>> aggregation_;
  std::unique_ptr<Equilibrator<Dim>> equilibrator_;
  MotionObserver<Dim> observer_;
};

}  // namespace floc
