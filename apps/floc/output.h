#pragma once

#include <functional>
#include <string>
#include <vector>

#include "command_line.h"
#include "floc/io/state_file.h"
#include "floc/io/table.h"

namespace floc {

/// Adds `--format table|csv|json`. `format` gets the keyword given, or stays empty.
void add_format_option(CommandLine app, std::string& format);

/// What `--format` asks for; without it a table on a terminal, csv otherwise.
TableFormat chosen_format(const std::string& format);

/// Prints a table on stdout in the format asked for. @throws IoError if stdout cannot take it (disk full).
void print_table(const Table& table, const std::string& format);

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

/// Reads each file and hands it to `work(file, state)`, which returns its exit code. A file that cannot be
/// read, or whose work throws, is reported by name on stderr and the others are still done.
/// @return the worst of the exit codes
int for_each_state(const std::vector<std::string>& files,
                   const std::function<int(const std::string& file, const AnyState& state)>& work);

}  // namespace floc
