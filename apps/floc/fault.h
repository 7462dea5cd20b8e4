#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace floc {

/// No result for a state, with why in words; the exit code is kNotConverged.
class NoResult : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a piece of work ended with: its exit code, or that of what it threw, with the words for stderr.
struct Fault {
  int code = 0;
  std::string message;
};
Fault fault_of(const std::string& file, const std::function<int()>& work);

}  // namespace floc
