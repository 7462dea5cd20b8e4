#pragma once

#include <chrono>

#include "floc/loading/run.h"

namespace floc {

/// Reports the progress of a run on stderr. On a terminal the report is one line that is redrawn; otherwise a new line
/// is printed every ten seconds.
class RunMonitor {
 public:
  explicit RunMonitor(int n_steps);

  /// Reports the present pressure, solid fraction and residual of a run while its grains are moving. Does nothing if
  /// too little time has passed since the last report.
  template <int Dim>
  void chunk(const Run<Dim>& run);
  /// Reports a state that the run has recorded at the end of a step.
  /// @param seconds  wall time of the step (s)
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
