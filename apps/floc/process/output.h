#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/io/table.h"
#include "floc/tables/remarks.h"
#include "process/command_line.h"
#include "process/output_files.h"

namespace floc {

/// Returns a span of time as text, in a suitable unit: "90 s", "35 min", "2.5 h", "3.0 days".
std::string duration_text(double seconds);

/// Returns the worse of two exit codes. From worst to best: kInterrupted, kFailure, kBadInput, kNotConverged,
/// kVerificationFailed, kDone.
int worse(int a, int b);

/// Adds the positional argument STATE... to a command. It takes one or more files, whose names go to `files`.
void add_states_argument(CommandLine app, std::vector<std::string>& files);

/// Calls `work`, which returns an exit code, with each file name. If `work` throws, the error is printed on stderr, and
/// the other files are still processed. @return worst of the exit codes
int for_each_file(const std::vector<std::string>& files,
                  const std::function<int(const std::string& file)>& work);

/// A function that processes a state read from a file and returns an exit code. The remarks of this function on all
/// states are collected. After the last state, each different remark is printed once.
using StateWork = std::function<int(const std::string& file, const AnyState& state, const Remarks& remarks)>;

/// Reads each file and calls `work` with its state. If a file cannot be read or `work` throws, the error and the name
/// of the file are printed on stderr, and the other files are still processed. @return worst of the exit codes
int for_each_state(const std::vector<std::string>& files, const StateWork& work);

}  // namespace floc
