#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "floc/assembly/aggregation.h"
#include "floc/base/random.h"
#include "floc/loading/run_options.h"
#include "floc/loading/run_plan.h"
#include "floc/packing/state.h"
#include "floc/relaxation/equilibrator.h"

namespace floc {

/// Point that a run has reached between two chunks of time steps, as stored in checkpoints. This point, the options of
/// the run and the packing determine how the run continues.
struct RunPoint {
  int step = 0;  ///< number of the equilibrium that is computed at present, from 0
  /// whether the run is still aggregating the grains to one cluster (protocol "aggregation")
  bool aggregating = false;
  bool shaken = false;  ///< whether the packing has already been vibrated before this equilibrium
  /// progress of the relaxation to this equilibrium, as text; empty before the first chunk of time steps
  std::string equilibration;
  double equilibration_time = 0.0;       ///< simulated time of this relaxation so far (time)
  std::int64_t equilibration_steps = 0;  ///< number of time steps of this relaxation so far
  std::uint64_t stream_state = 0;        ///< state of the random number generator
  double time = 0.0;                     ///< simulated time of the run before this relaxation (time)
  std::int64_t n_steps = 0;              ///< number of time steps of the run before this relaxation
  double aggregation_skin = 0.0;  ///< skin of the Verlet lists of neighbours during the aggregation (length)
  std::string parent_sha256;      ///< SHA-256 checksum of the last saved state file
  /// sides of the cell, and stress on each axis, in the last saved state
  std::vector<double> last_sides, last_stress;
  /// component along the first axis (length), before this relaxation, of the lattice vector that a simple shear tilts
  double last_offset = 0.0;
  /// load stage of this equilibrium, with the sides and stresses at the start of the stage; empty if the stage loads
  /// all axes equally
  StageReference turn;
};

/// Returns the point that a run has reached just after an equilibrium was saved. From this point and the packing of the
/// state, the run can be continued without a checkpoint.
/// @param sha256  SHA-256 checksum of the file in which the state was saved
template <int Dim>
RunPoint point_after(const State<Dim>& state, const std::string& sha256);

/// Returns the stress of a state as text for messages: "P = 1" or, if the load path drives one axis, "P = 1 (mean), 2
/// (driven)". For an axis with an imposed stress, P is the imposed stress; for an axis with an imposed length, P is the
/// stress in the packing.
template <int Dim>
std::string imposed_pressure_text(const State<Dim>& state);

/// Outcome of one chunk of time steps.
enum class RunEvent {
  chunk,        ///< no equilibrium yet; the run may be stopped here and continued later, with identical results
  equilibrium,  ///< the next equilibrium is reached; the caller then saves state() and calls saved()
  gave_up,      ///< the packing does not come to equilibrium under the present load; report() gives the reason
};

/// A whole run: the assembly of a packing, then every equilibrium of the load path. This class writes no files: the
/// caller saves the states.
template <int Dim>
class Run {
 public:
  /// Starts a run from its beginning.
  /// @throws InputError if the options are invalid
  explicit Run(RunOptions options);
  /// Continues a run from a point that it has reached before. The point is read from a checkpoint or made by
  /// point_after().
  /// @param packing  packing of the run at this point
  Run(RunOptions options, RunPoint point, Packing<Dim> packing);

  const std::vector<PlannedEquilibrium>& plan() const { return plan_; }
  bool finished() const { return point_.step == static_cast<int>(plan_.size()); }

  /// Sets the observer, a function that is called while the packing moves. Its arguments are the packing and the time
  /// since the beginning of the run.
  /// @pre this object is not moved or copied afterwards, because it passes its own address on to the object that moves
  /// the packing
  void set_observer(MotionObserver<Dim> observer);

  /// Advances the run by one chunk of time steps.
  /// @pre the run is not finished, and saved() was called after the last equilibrium
  RunEvent advance();
  /// Returns the present state of the run, with a copy of its packing. If advance() has just returned
  /// RunEvent::equilibrium, this state is the equilibrium.
  State<Dim> state() const;
  /// Returns the present state of the run, and moves the packing into it. The packing must be given back by
  /// restore_packing() before this object is used again.
  State<Dim> release_state();
  void restore_packing(Packing<Dim> packing);
  /// Starts the computation of the next equilibrium, after the caller has saved the last one.
  /// @param sha256  SHA-256 checksum of the file in which the last equilibrium was saved
  void saved(const std::string& sha256);

  const RunPoint& point() const { return point_; }
  const Packing<Dim>& packing() const;
  const PlannedEquilibrium& target() const { return plan_[point_.step]; }
  /// Returns the mean of the stresses on all axes (force/length^(Dim-1)). The stress on an axis is the imposed stress
  /// or, for an axis with an imposed length, the stress in the packing.
  double pressure() const;
  /// Returns the stress on the moving packing as text for messages, in the form of imposed_pressure_text().
  std::string pressure_text() const;
  /// Returns a report on how far the packing is from equilibrium under the present load.
  RelaxationReport report() const;
  int n_clusters() const { return aggregation_ ? aggregation_->n_clusters() : 1; }

 private:
  Packing<Dim> saved_packing();
  Packing<Dim> gas(RandomStream& random) const;
  void take(Packing<Dim> packing);
  void give_own_masses(Packing<Dim>& packing) const;
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
  /// Packing of the run. While the packing is in aggregation_ or equilibrator_, this member is empty, so that the
  /// packing is in memory only once.
  Packing<Dim> packing_;
  /// masses of the grains, in the order of the packing, if RelaxationOptions::equal_masses is set; otherwise empty
  std::vector<double> own_masses_;
  std::unique_ptr<Aggregation<Dim>> aggregation_;
  std::unique_ptr<Equilibrator<Dim>> equilibrator_;
  MotionObserver<Dim> observer_;
};

}  // namespace floc
