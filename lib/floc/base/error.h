#pragma once

#include <stdexcept>
#include <string>

namespace floc {

/// Error in the input of the user. The message gives the place (a file, with a line or dataset), the key or option at
/// fault, the given value, and the expected value. The program prints this message and ends with exit code 4.
class InputError : public std::runtime_error {
 public:
  /// @param place  file, "file:line" or "file:/dataset", printed before `problem`; may be empty
  /// @param problem  key or option at fault, its value and the expected value
  InputError(const std::string& place, const std::string& problem);
};

/// Failure outside floc while a file is read or written, for example a full disk or a directory that is not writable.
/// The program ends with exit code 1.
class IoError : public std::runtime_error {
 public:
  IoError(const std::string& place, const std::string& problem);
};

/// Error of a computation that has no result for a state, although the input is valid. The message gives the reason.
/// The program ends with exit code 3.
class NoResult : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace floc
