#pragma once

#include "floc/base/processor_seconds.h"

namespace floc {

/// Processor time after which a study has to end. On a free core it equals wall time; on a busy one, or while the
/// process is suspended, waiting does not count.
class Deadline {
 public:
  /// @param seconds  of processor time from now on
  explicit Deadline(double seconds) : end_(processor_seconds() + seconds) {}
  /// Returns the processor time that is left (s); negative after the deadline.
  double left() const { return end_ - processor_seconds(); }
  bool passed() const { return left() <= 0.0; }

 private:
  double end_;
};

}  // namespace floc
