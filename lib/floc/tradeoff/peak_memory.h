#pragma once

namespace floc {

/// Largest memory that this process takes while the object exists, beyond that which it takes when the object is made.
/// There may be one such object at a time.
class PeakMemory {
 public:
  PeakMemory();
  /// Returns the largest additional resident memory so far (MB); NaN if the operating system does not tell it.
  double megabytes() const;

 private:
  double before_;
};

}  // namespace floc
