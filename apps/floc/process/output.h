#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "floc/io/table.h"
#include "floc/tables/remarks.h"
#include "process/command_line.h"

namespace floc {

/// Writes a table as csv. @throws IoError if the file cannot take it.
void write_csv(const std::string& path, const Table& table);

/// A span of time as text, in the unit that suits it: "90 s", "35 min", "2.5 h", "3.0 days".
std::string duration_text(double seconds);

/// The worse of two exit codes: failure inside, bad input, not converged, verification failed, done.
int worse(int a, int b);

/// Adds the positional argument STATE..., one file or more.
void add_states_argument(CommandLine app, std::vector<std::string>& files);

/// Hands each file name to `work`, which returns its exit code. One that throws is reported on stderr, and the
/// others are still done. @return the worst of the exit codes
int for_each_file(const std::vector<std::string>& files,
                  const std::function<int(const std::string& file)>& work);

/// Work on a state that was read from a file; returns its exit code. Remarks are kept until the last state, and each is
/// printed once.
using StateWork = std::function<int(const std::string& file, const AnyState& state, const Remarks& remarks)>;

/// Reads each file and hands it to `work`. A file that cannot be read, or whose work throws, is reported by name on
/// stderr and the others are still done. @return the worst of the exit codes
int for_each_state(const std::vector<std::string>& files, const StateWork& work);

}  // namespace floc
