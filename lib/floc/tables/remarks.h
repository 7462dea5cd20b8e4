#pragma once

#include <functional>
#include <string>
#include <utility>

namespace floc {

/// Receives what a computation reports about a file besides its result: warnings, and methods that replaced those asked
/// for. The program prints remarks on stderr, the Python package turns them into warnings.
class Remarks {
 public:
  /// @param severity  among remarks that differ in their numbers alone, the largest is the worst
  using Receiver = std::function<void(const std::string& file, const std::string& text, double severity)>;

  /// Makes remarks without a receiver: they are dropped.
  Remarks() = default;
  explicit Remarks(Receiver receiver) : receiver_(std::move(receiver)) {}

  void remark(const std::string& file, const std::string& text, double severity = 0.0) const {
    if (receiver_) receiver_(file, text, severity);
  }
  void warn(const std::string& file, const std::string& text, double severity = 0.0) const {
    remark(file, "warning: " + text, severity);
  }

 private:
  Receiver receiver_;
};

/// Returns the first number in a text, which is its severity if it is a count or an error; 0 without a number.
double first_number(const std::string& text);

}  // namespace floc
