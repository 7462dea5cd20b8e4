#pragma once

#include <functional>
#include <string>

namespace floc {

/// Outcome of a piece of work: its exit code or, if it threw, the exit code of the exception and a message for stderr.
struct Fault {
  int code = 0;
  std::string message;
};
/// Runs `work` and catches its exceptions. @param file  name of the file that `work` processes; it is added to messages
/// that do not contain it
Fault fault_of(const std::string& file, const std::function<int()>& work);

}  // namespace floc
