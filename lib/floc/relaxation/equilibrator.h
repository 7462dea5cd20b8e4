#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "floc/elasticity/stability.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/load_target.h"
#include "floc/relaxation/motion_observer.h"
#include "floc/relaxation/relaxation_options.h"

namespace floc {

enum class RelaxationStatus { running, converged, gave_up };

/// Report of a relaxation: its result, or its progress so far.
struct RelaxationReport {
  Residuals residuals;
  Stability stability;  ///< stability of an equilibrium; not determined before
  /// Number of bridges that would form or break if the liquid of an equilibrium were shared out once more; -1
  /// before the equilibrium, and without liquid.
  int n_bridges_unsettled = -1;
  /// Number of mechanisms of the structure between walls; -1: not counted. A state with mechanisms is not an
  /// equilibrium.
  int n_mechanisms = -1;
  /// Kind of the end: "polished", "dynamic", "static", "stopped" (between walls, recorded without equilibrium),
  /// "diverged", "lost", "unloaded" or "closed"; empty while the relaxation runs, and where it exceeded its
  /// time.
  std::string ending;
  std::string blocking;  ///< criterion that is not met, in words
  double decay_rate =
      0.0;            ///< decay rate of a force residual above its tolerance (1/time); positive when it falls
  std::string phase;  ///< present phase: "moving", "finishing", ...
  double time = 0.0;  ///< simulated time of this relaxation so far
  std::int64_t n_steps = 0;  ///< time steps of this relaxation so far
};

/// Takes a packing to equilibrium under a load, chunk by chunk. Between two chunks the packing and progress()
/// are its whole state: an equilibrator made from them continues with identical results.
template <int Dim>
class Equilibrator {
 public:
  virtual ~Equilibrator() = default;

  /// Advances by one chunk.
  virtual RelaxationStatus advance() = 0;
  /// Sets the observer of the packing as it moves.
  virtual void set_observer(MotionObserver<Dim> observer) = 0;

  virtual const Packing<Dim>& packing() const = 0;
  /// Moves the packing out, so that a large one is held only once. No other member may be called afterwards.
  virtual Packing<Dim> release_packing() = 0;
  /// Static stress of the packing as it is now (force/length^(Dim-1)).
  virtual const Mat<Dim>& stress() const = 0;
  /// Stress on each axis, compression positive: the stress imposed, or the one carried now where a length is
  /// imposed.
  virtual const Vec<Dim>& target_stress() const = 0;
  virtual RelaxationReport report() const = 0;
  /// Progress as text, which equilibrators of the same kind can read.
  virtual std::string progress() const = 0;
};

/// Makes the equilibrator of a packing: Relaxer, or BoxRelaxer where the packing has walls.
/// @param load  stress or length imposed on each axis
/// @param progress       of an equilibrator that was stopped; empty: from the beginning
/// @throws InputError if `progress` is not one of this kind of equilibrator
template <int Dim>
std::unique_ptr<Equilibrator<Dim>> make_equilibrator(const RelaxationOptions& options, Packing<Dim> packing,
                                                     const LoadTarget<Dim>& load,
                                                     const std::string& progress = "");

/// @param target_stress  stress on each axis, compression positive
template <int Dim>
std::unique_ptr<Equilibrator<Dim>> make_equilibrator(const RelaxationOptions& options, Packing<Dim> packing,
                                                     const Vec<Dim>& target_stress,
                                                     const std::string& progress = "") {
  return make_equilibrator<Dim>(options, std::move(packing), LoadTarget<Dim>::normal_stress(target_stress),
                                progress);
}

}  // namespace floc
