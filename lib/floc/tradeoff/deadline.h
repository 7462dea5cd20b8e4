#pragma once

#include <algorithm>

#include "floc/base/processor_seconds.h"

namespace floc {

/// Deadline for the work of this process, in processor time. While the process waits, because it is suspended or
/// because other processes occupy the core, its processor time does not increase.
class Deadline {
 public:
  /// @param seconds  processor time from now until the deadline (s)
  explicit Deadline(double seconds) : end_(processor_seconds() + seconds) {}
  /// Returns the processor time until the deadline (s); negative after the deadline.
  double left() const { return end_ - processor_seconds(); }
  bool passed() const { return left() <= 0.0; }
  /// Returns the earlier of two deadlines: `seconds` of processor time from now, and this deadline.
  Deadline within(double seconds) const { return Deadline(std::min(seconds, left())); }

 private:
  double end_;
};

}  // namespace floc
