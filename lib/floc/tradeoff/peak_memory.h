#pragma once

namespace floc {

/// Measures how far the memory of this process rises, while the object exists, above its value at the construction of
/// the object. Only one such object may exist at a time.
class PeakMemory {
 public:
  PeakMemory();
  /// Returns the largest additional resident memory so far (MB); NaN if the operating system does not report it.
  double megabytes() const;

 private:
  double before_;
};

}  // namespace floc
