#include "floc/tradeoff/peak_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "floc/base/return_freed_memory.h"

namespace floc {
namespace {

/// Returns the number (MB) in the entry `name` of /proc/self/status, such as "VmHWM:" for the largest resident memory;
/// NaN if there is no such entry.
double status_entry(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kilobytes = 0.0; word == name && status >> kilobytes) return kilobytes / 1024.0;
  return std::numeric_limits<double>::quiet_NaN();
}

/// Resets the largest resident memory that Linux has recorded (VmHWM) to the present resident memory, see proc(5).
bool reset_largest() {
  std::ofstream file("/proc/self/clear_refs");
  file << '5' << std::flush;
  return file.good();
}

}  // namespace

PeakMemory::PeakMemory() : before_(std::numeric_limits<double>::quiet_NaN()) {
  return_freed_memory();
  if (reset_largest()) before_ = status_entry("VmRSS:");
}

double PeakMemory::megabytes() const {
  return std::max(0.0, status_entry("VmHWM:") - before_) + 0.0 * before_;
}

}  // namespace floc
