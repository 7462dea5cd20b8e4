#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace floc {

/// Working directory and output files of a child process.
struct ChildOptions {
  std::string directory;  ///< working directory of the child; empty: working directory of this process
  /// File that receives the stdout of the child and is replaced; empty: stdout of this process.
  std::string output;
  std::string log;      ///< file that receives the stderr of the child; empty: stderr of this process
  bool append = false;  ///< whether the child appends to the file `log` instead of replacing it
};

/// Starts this program in a child process. The child is killed when this process ends: otherwise a resumed run could
/// write the same files as a child that is still alive. The file names in `options` are relative to the working
/// directory of this process.
/// @param arguments  arguments after the name of the program
/// @return process identifier of the child
/// @throws IoError if no process can be started
pid_t start_floc(const std::vector<std::string>& arguments, const ChildOptions& options);

/// Converts the status of waitpid() to an exit code: the exit code of the process or, if a signal ended the process,
/// 128 plus the number of the signal.
int exit_code_of(int status);

/// Waits until a child process ends; a signal to this process does not end the waiting. @return exit code of the child,
/// as exit_code_of() returns it
int wait_for(pid_t child);

/// Installs signal handlers: SIGINT and SIGTERM then no longer end this process. If one of these signals arrives while
/// run_floc() waits for a child process, the child receives SIGTERM. If the child is a run, it writes its checkpoint
/// and ends.
void pass_signals_on();

/// Returns whether SIGINT or SIGTERM has arrived since pass_signals_on().
bool was_signalled();

/// Starts this program in a child process and waits for it. @return exit code of the child, as exit_code_of() returns
/// it
/// @throws IoError if no process can be started
int run_floc(const std::vector<std::string>& arguments, const ChildOptions& options);

/// Returns the path of the executable of this program.
std::string this_program();

}  // namespace floc
