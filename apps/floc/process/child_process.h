#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace floc {

/// Where a child process works and writes.
struct ChildOptions {
  std::string directory;  ///< it works in; empty: this one's
  std::string output;     ///< file that its stdout replaces; empty: this one's stdout
  std::string log;        ///< file that its stderr goes to; empty: this one's stderr
  bool append = false;    ///< to the log, instead of writing it anew
};

/// Starts this program once more. The child does not outlive this process: what resumes its work would find two
/// processes at it. Files are named relative to the directory of this process.
/// @param arguments  those after the name of the program
/// @return its process
/// @throws IoError if no process can be started
pid_t start_floc(const std::vector<std::string>& arguments, const ChildOptions& options);

/// How a process ended, from the status of waitpid(): its exit code, or 128 and the number of the signal that ended it.
int exit_code_of(int status);

/// Waits for a child, through signals. @return as exit_code_of()
int wait_for(pid_t child);

/// From here on SIGINT and SIGTERM do not end this process, but go to the child that run_floc() waits for, if any, as
/// SIGTERM, on which a run writes its checkpoint.
void pass_signals_on();

/// Whether such a signal has come.
bool was_signalled();

/// Starts this program once more and waits for it. @return as exit_code_of()
/// @throws IoError as start_floc()
int run_floc(const std::vector<std::string>& arguments, const ChildOptions& options);

/// Path of this program.
std::string this_program();

}  // namespace floc
