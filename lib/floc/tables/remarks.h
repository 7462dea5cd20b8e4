#pragma once

#include <functional>
#include <string>
#include <utility>

namespace floc {

/// Passes on the remarks that a computation makes about a file. A remark is a warning, or a note that the chosen method
/// was replaced by another method. The program prints remarks on stderr, and the Python package turns them into Python
/// warnings.
class Remarks {
 public:
  /// Function that receives a remark.
  /// @param severity  measure of how serious the remark is. If several remarks differ only in their numbers, the remark
  /// with the largest severity is the most serious
  using Receiver = std::function<void(const std::string& file, const std::string& text, double severity)>;

  /// Creates an object that ignores all remarks.
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

/// Returns the first number in the text of a remark, which serves as its severity; 0 if the text contains no number.
double first_number(const std::string& text);

}  // namespace floc
