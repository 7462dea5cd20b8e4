#pragma once

#include <functional>
#include <string>

namespace floc {

/// What a piece of work ended with: its exit code, or that of what it threw, with the words for stderr.
struct Fault {
  int code = 0;
  std::string message;
};
Fault fault_of(const std::string& file, const std::function<int()>& work);

}  // namespace floc
