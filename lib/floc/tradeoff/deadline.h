#pragma once

#include "floc/base/processor_seconds.h"

namespace floc {

/// Deadline of a study, measured in processor time. On a free core processor time equals wall time. On a busy core, or
/// while the process is suspended, the time of waiting does not count.
class Deadline {
 public:
  /// @param seconds  processor time from now until the deadline (s)
  explicit Deadline(double seconds) : end_(processor_seconds() + seconds) {}
  /// Returns the processor time that is left until the deadline (s); negative after the deadline.
  double left() const { return end_ - processor_seconds(); }
  bool passed() const { return left() <= 0.0; }

 private:
  double end_;
};

}  // namespace floc
