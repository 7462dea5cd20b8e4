#include "floc/base/free_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace floc {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Returns the memory (bytes) that the operating system can allocate without swapping.
double available_on_machine() {
  std::ifstream in("/proc/meminfo");
  double kilobytes = 0.0;
  for (std::string name, unit; in >> name >> kilobytes; std::getline(in, unit))
    if (name == "MemAvailable:") return 1024.0 * kilobytes;
  return kUnknown;
}

double left_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnknown;
  std::ifstream in("/proc/self/statm");
  double pages = 0.0;
  in >> pages;
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Returns the memory (bytes) that this process can still use before its control group, for example a container or a
/// batch job, reaches the limit of its memory. Only version 2 of control groups is supported.
double left_of_control_group() {
  std::ifstream most("/sys/fs/cgroup/memory.max"), used("/sys/fs/cgroup/memory.current");
  double limit = 0.0, now = 0.0;
  if (!(most >> limit) || !(used >> now)) return kUnknown;
  return limit - now;
}

}  // namespace

double free_memory() {
  return std::max(0.0, std::min({available_on_machine(), left_of_address_space(), left_of_control_group()}));
}

}  // namespace floc
