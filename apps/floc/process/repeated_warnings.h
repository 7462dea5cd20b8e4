#pragma once

#include <string>
#include <vector>

#include "floc/tables/remarks.h"

namespace floc {

/// Collects the remarks on many states. Texts that differ only in their numbers count as one remark. The destructor
/// prints each remark once: the text for the worst state, and the number of states with this remark.
class RepeatedWarnings {
 public:
  RepeatedWarnings() = default;
  ~RepeatedWarnings();
  RepeatedWarnings(const RepeatedWarnings&) = delete;
  RepeatedWarnings& operator=(const RepeatedWarnings&) = delete;

  /// Returns a Remarks object that passes its remarks to this collector. The collector must outlive this object.
  Remarks remarks();

 private:
  struct Warning {
    std::string kind;  ///< text of the remark without its numbers
    std::string file, text;
    double severity = 0.0;
    int n_states = 1;
  };

  void keep(const std::string& file, const std::string& text, double severity);

  std::vector<Warning> kept_;
};

/// Returns a Remarks object that prints its texts on stderr immediately, as "floc: FILE: TEXT".
Remarks printed_remarks();

}  // namespace floc
