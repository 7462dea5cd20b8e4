#pragma once

namespace floc {

/// Measures the largest increase of the memory of this process since the construction of the object. Only one object of
/// this class may exist at a time.
class PeakMemory {
 public:
  PeakMemory();
  /// Returns the largest additional resident memory so far (MB); NaN if the operating system does not report it.
  double megabytes() const;

 private:
  double before_;
};

}  // namespace floc
