#pragma once

#include <stdexcept>
#include <string>

namespace floc {

/// Bad input: names the place (file, with line or dataset), the key, its value, and what was expected.
/// The program turns it into one message and exit code 4.
class InputError : public std::runtime_error {
 public:
  /// @param place    file, "file:line" or "file:/dataset"
  /// @param problem  key, value and expectation in words
  InputError(const std::string& place, const std::string& problem);
};

/// Something outside floc failed during reading or writing: disk full, directory not writable. Exit code 1.
class IoError : public std::runtime_error {
 public:
  IoError(const std::string& place, const std::string& problem);
};

/// A computation has no result for a state although the input is valid; the message gives the reason. Exit code
/// 3.
class NoResult : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace floc
