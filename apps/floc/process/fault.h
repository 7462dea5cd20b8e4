#pragma once

#include <functional>
#include <string>

namespace floc {

/// Outcome of a function: its exit code or, if it threw an exception, the exit code for this exception and a message
/// for stderr.
struct Fault {
  int code = 0;
  std::string message;
};
/// Runs `work` and catches its exceptions.
/// @param file  name of the file that `work` processes; the name is put in front of a message that does not contain it
Fault fault_of(const std::string& file, const std::function<int()>& work);

}  // namespace floc
