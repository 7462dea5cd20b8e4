#pragma once

#include <chrono>

#include "floc/loading/run.h"

namespace floc {

/// Reports the progress of a run on stderr: on a terminal as one line that is redrawn, otherwise as a line from time to
/// time.
class RunMonitor {
 public:
  explicit RunMonitor(int n_steps);

  /// Reports the state of a run that is in motion.
  template <int Dim>
  void chunk(const Run<Dim>& run);
  /// Reports an equilibrium. @param seconds  wall time of the step (s)
  template <int Dim>
  void equilibrium(const State<Dim>& state, const RelaxationReport& report, double seconds);

 private:
  using Clock = std::chrono::steady_clock;

  double expected_seconds_left(int steps_left) const;

  int n_steps_;
  bool terminal_;
  Clock::time_point last_line_;
  double seconds_done_ = 0.0;
  int steps_done_ = 0;
};

}  // namespace floc
