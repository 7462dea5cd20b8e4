#pragma once

#include <string>
#include <vector>

#include "floc/tables/remarks.h"

namespace floc {

/// Collects the remarks on many states and prints each once, when it is destroyed: with the text of the worst state and
/// the number of states. Texts that differ only in their numbers are one remark.
class RepeatedWarnings {
 public:
  RepeatedWarnings() = default;
  ~RepeatedWarnings();
  RepeatedWarnings(const RepeatedWarnings&) = delete;
  RepeatedWarnings& operator=(const RepeatedWarnings&) = delete;

  /// Returns remarks that this object receives; it has to outlive them.
  Remarks remarks();

 private:
  struct Warning {
    std::string kind;  ///< text without its numbers
    std::string file, text;
    double severity = 0.0;
    int n_states = 1;
  };

  void keep(const std::string& file, const std::string& text, double severity);

  std::vector<Warning> kept_;
};

/// Returns remarks that are printed on stderr immediately: "floc: FILE: TEXT".
Remarks printed_remarks();

}  // namespace floc
