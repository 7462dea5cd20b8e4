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

/// How a relaxation ended, or its progress, in numbers and text.
struct RelaxationReport {
  Residuals residuals;
  Stability stability;  ///< of an equilibrium; not tested before it
  /// Bridges that would form or break if the liquid of an equilibrium were shared out once more; -1 before, and
  /// without liquid.
  int n_bridges_unsettled = -1;
  /// Mechanisms of the structure between walls, -1: not counted. A state that has some is not an equilibrium.
  int n_mechanisms = -1;
  /// "polished", "dynamic", "static", "stopped" (recorded as it is, between walls), "diverged",
  /// "unloaded", "closed"; empty while it runs.
  std::string ending;
  std::string blocking;  ///< criterion that keeps it from being an equilibrium, in words
  double decay_rate =
      0.0;            ///< of a force residual that is above its tolerance (1/time); positive when it falls
  std::string phase;  ///< what it is doing: "moving", "finishing", ...
  double time = 0.0;  ///< simulated time of this relaxation so far
  std::int64_t n_steps = 0;  ///< time steps of this relaxation so far
};

/// Takes a packing to equilibrium under a load, chunk by chunk. Between two chunks its state is the
/// packing and the progress: an equilibrator made from them goes on as if it had never been stopped.
template <int Dim>
class Equilibrator {
 public:
  virtual ~Equilibrator() = default;

  /// One chunk.
  virtual RelaxationStatus advance() = 0;
  /// Sets the observer of the packing as it moves.
  virtual void set_observer(MotionObserver<Dim> observer) = 0;

  virtual const Packing<Dim>& packing() const = 0;
  /// Gives the packing away, so that a large one is held only once. Nothing else may be asked afterwards.
  virtual Packing<Dim> release_packing() = 0;
  /// Static stress of the packing as it is now.
  virtual const Mat<Dim>& stress() const = 0;
  /// What each axis is loaded with: the stress imposed, or carried now where a length is imposed.
  virtual const Vec<Dim>& target_stress() const = 0;
  virtual RelaxationReport report() const = 0;
  /// Its progress, as text that only equilibrators of the same kind can read.
  virtual std::string progress() const = 0;
};

/// The explicit relaxer (relaxer.h), or that of boxes where the packing has walls (box_relaxer.h).
/// @param load           what is imposed on each axis
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
