#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace floc {

/// Working directory and output files of a child process.
struct ChildOptions {
  std::string directory;  ///< its working directory; empty: that of this process
  std::string output;     ///< file for its stdout, which is replaced; empty: stdout of this process
  std::string log;        ///< file for its stderr; empty: stderr of this process
  bool append = false;    ///< append to the log instead of replacing it
};

/// Starts this program in a child process. The child ends with this process: otherwise two processes would work on its
/// files when the work is resumed. File names are relative to the directory of this process.
/// @param arguments  arguments after the name of the program
/// @return identifier of its process
/// @throws IoError if no process can be started
pid_t start_floc(const std::vector<std::string>& arguments, const ChildOptions& options);

/// Converts the status of waitpid() to an exit code: that of the process, or 128 plus the number of the signal that
/// ended it.
int exit_code_of(int status);

/// Waits for a child; signals do not end the waiting. @return exit code as by exit_code_of()
int wait_for(pid_t child);

/// Makes SIGINT and SIGTERM no longer end this process. If run_floc() waits for a child, the signal is sent to it as
/// SIGTERM, on which a run writes its checkpoint.
void pass_signals_on();

/// Returns whether such a signal has arrived.
bool was_signalled();

/// Starts this program in a child process and waits for it. @return exit code as by exit_code_of()
/// @throws IoError if no process can be started
int run_floc(const std::vector<std::string>& arguments, const ChildOptions& options);

/// Returns the path of this program.
std::string this_program();

}  // namespace floc
