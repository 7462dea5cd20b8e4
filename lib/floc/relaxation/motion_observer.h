#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "floc/relaxation/dynamics.h"

namespace floc {

/// Function that is called at regular intervals with a packing in motion. Observers do not change the results of a run.
template <int Dim>
struct MotionObserver {
  /// Simulated time between two calls of the observer (time), at most the duration of a chunk of time steps.
  double interval = 0.0;
  /// Function that is called with the packing; empty if there is no observer.
  /// @param time  simulated time since the beginning of the relaxation or, while grains aggregate, since the beginning
  /// of the chunk of time steps
  std::function<void(const Packing<Dim>& packing, double time)> callback;
};

/// Advances a packing by a chunk of time steps. The chunk is divided into equal parts, each of which lasts about one
/// interval of the observer. The observer is called after each part, so the last call is at the end of the chunk.
/// @param start  simulated time at the beginning of the chunk (time)
template <int Dim>
void advance_observed(Dynamics<Dim>& dynamics, int n_steps, Motion motion, const MotionObserver<Dim>& observer,
                      double start, double time_step) {
  if (!observer.callback) return dynamics.advance(n_steps, motion);
  const int n_parts = static_cast<int>(
      std::clamp(std::round(n_steps * time_step / observer.interval), 1.0, static_cast<double>(n_steps)));
  for (int part = 0, done = 0; part < n_parts && dynamics.finite(); ++part) {
    const int next = static_cast<int>(static_cast<long>(n_steps) * (part + 1) / n_parts);
    dynamics.advance(next - done, motion);
    done = next;
    if (dynamics.finite()) observer.callback(dynamics.packing(), start + done * time_step);
  }
}

}  // namespace floc
