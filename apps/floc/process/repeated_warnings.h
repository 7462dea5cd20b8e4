#pragma once

#include <string>
#include <vector>

#include "floc/tables/remarks.h"

namespace floc {

/// Keeps the remarks made on many states and prints each once at its end: the one of the worst state, with the number
/// of states. Texts that differ in their numbers alone are one remark.
class RepeatedWarnings {
 public:
  RepeatedWarnings() = default;
  ~RepeatedWarnings();
  RepeatedWarnings(const RepeatedWarnings&) = delete;
  RepeatedWarnings& operator=(const RepeatedWarnings&) = delete;

  /// Hands remarks to this object, which has to outlive them.
  Remarks remarks();

 private:
  struct Warning {
    std::string kind;  ///< its text without numbers
    std::string file, text;
    double severity = 0.0;
    int n_states = 1;
  };

  void keep(const std::string& file, const std::string& text, double severity);

  std::vector<Warning> kept_;
};

/// Prints each remark on stderr at once: "floc: FILE: TEXT".
Remarks printed_remarks();

}  // namespace floc
