#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "floc/relaxation/dynamics.h"

namespace floc {

/// Observer of a packing while it moves. It does not change the results of a run.
template <int Dim>
struct MotionObserver {
  double interval = 0.0;  ///< simulated time between two calls, at most a chunk (time)
  /// @param time  since the beginning of the relaxation, or of the chunk where grains aggregate
  std::function<void(const Packing<Dim>& packing, double time)> callback;  ///< empty: not observed
};

/// Advances by a chunk of steps, in equal parts of about the observer's interval, and calls the observer after
/// each part, and so at the end of the chunk.
/// @param start  time at the beginning of the chunk (time)
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
