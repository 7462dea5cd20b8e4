#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "floc/elasticity/stability.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/load_target.h"
#include "floc/packing/motion_record.h"
#include "floc/packing/step_counts.h"
#include "floc/relaxation/motion_observer.h"
#include "floc/relaxation/relaxation_options.h"

namespace floc {

enum class RelaxationStatus { running, converged, gave_up };

/// Report of a relaxation: its result, or its progress so far.
struct RelaxationReport {
  Residuals residuals;
  Stability stability;  ///< stability of the equilibrium; unknown before the relaxation ends
  /// Number of liquid bridges that would form or break if the liquid of the equilibrium were shared out once more; -1
  /// before an equilibrium is found and in packings without liquid.
  int n_bridges_unsettled = -1;
  /// Number of mechanisms (motions without stiffness) of the structure that carries the load between walls; -1 if
  /// mechanisms have not been counted. A state with mechanisms is not an equilibrium.
  int n_mechanisms = -1;
  /// Keyword for the end of the relaxation; empty while the relaxation runs, and after a relaxation that took too long.
  /// After a success:
  /// - "polished": equilibrium found by dynamics and then Newton steps
  /// - "dynamic": equilibrium found by dynamics alone
  /// - "static": equilibrium found by Newton steps alone
  /// - "stopped": state of a packing between walls that is recorded although it is not an equilibrium
  /// - "closest", "canonical", "stepped": equilibrium of rigid grains (RigidForces)
  /// - "moving": rigid grains recorded in motion at an imposed strain
  ///
  /// After a failure:
  /// - "diverged": the time step was too large
  /// - "lost": grains and walls no longer form a packing
  /// - "unloaded": at the imposed lengths the packing carries no stress
  /// - "closed": the imposed lengths are too short
  std::string ending;
  std::string blocking;  ///< description of the first criterion of equilibrium that the packing does not meet
  /// Decay rate of the force residual (1/time), positive if the residual falls; computed only while the residual is
  /// above its tolerance.
  double decay_rate = 0.0;
  std::string phase;         ///< present phase: "moving" or "finishing"
  double time = 0.0;         ///< simulated time of this relaxation so far (time)
  std::int64_t n_steps = 0;  ///< number of time steps of this relaxation so far
  /// number of these steps that grains in contact dynamics made from rest, which do not count as simulated time; 0 in
  /// the phase "moving"
  int n_resting_steps = 0;
  /// record of a packing in motion: the time step that begins in the recorded state
  std::optional<MotionRecord> motion = {};
  /// counts of the time steps of contact dynamics in this relaxation so far; all zero if the contacts are elastic
  StepCounts counts;
};

/// Takes a packing to equilibrium under a load, in chunks of time steps. Between two chunks, the packing and progress()
/// are the whole state of the equilibrator. A new equilibrator that is made from both continues with identical results.
template <int Dim>
class Equilibrator {
 public:
  virtual ~Equilibrator() = default;

  /// Advances the relaxation by one chunk of time steps.
  virtual RelaxationStatus advance() = 0;
  /// Sets the observer that is called while the packing moves.
  virtual void set_observer(MotionObserver<Dim> observer) = 0;

  virtual const Packing<Dim>& packing() const = 0;
  /// Moves the packing out of this object, so that a large packing is stored only once. No other member function may be
  /// called afterwards.
  virtual Packing<Dim> release_packing() = 0;
  /// Returns the static stress of the packing in its present state (force/length^(Dim-1)).
  virtual const Mat<Dim>& stress() const = 0;
  /// Returns the stress on each axis, compression positive (force/length^(Dim-1)): the imposed stress or, for an axis
  /// with an imposed length, the present stress in the packing.
  virtual const Vec<Dim>& target_stress() const = 0;
  virtual RelaxationReport report() const = 0;
  /// Returns the progress as text, from which an equilibrator of the same kind can be made.
  virtual std::string progress() const = 0;
};

/// Makes the equilibrator of a packing: a ContactDynamicsRelaxer if its contacts are rigid or its grains have corners,
/// otherwise a BoxRelaxer if the packing has walls, otherwise a SoftRelaxer if the options contain a softening of the
/// springs, otherwise a Relaxer.
/// @param load  stress or length imposed on each axis
/// @param progress  text from progress() of an equilibrator that was stopped; if empty, the relaxation starts from the
/// beginning
/// @throws InputError if `progress` does not come from an equilibrator of the same kind
template <int Dim>
std::unique_ptr<Equilibrator<Dim>> make_equilibrator(const RelaxationOptions& options, Packing<Dim> packing,
                                                     const LoadTarget<Dim>& load,
                                                     const std::string& progress = "");

/// Makes the equilibrator of a packing under a stress imposed on each axis.
/// @param target_stress  stress on each axis, compression positive (force/length^(Dim-1))
template <int Dim>
std::unique_ptr<Equilibrator<Dim>> make_equilibrator(const RelaxationOptions& options, Packing<Dim> packing,
                                                     const Vec<Dim>& target_stress,
                                                     const std::string& progress = "") {
  return make_equilibrator<Dim>(options, std::move(packing), LoadTarget<Dim>::normal_stress(target_stress),
                                progress);
}

}  // namespace floc
