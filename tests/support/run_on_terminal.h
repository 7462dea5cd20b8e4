#pragma once

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

#include "support/run_program.h"

namespace floc::test {

/// Runs floc with its standard output on a terminal that is `columns` characters wide. The standard error is captured
/// separately.
/// @return text written to the terminal, with lines ending in \n
inline Outcome run_on_terminal(const std::string& arguments, const std::string& directory, int columns) {
  const ScratchDirectory scratch;
  winsize size{};
  size.ws_row = 50;
  size.ws_col = static_cast<unsigned short>(columns);
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    const std::string command = "cd '" + directory + "' && exec " + floc_program() + " " + arguments + " 2>'" +
                                scratch.file("err") + "'";
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  std::string out;
  char buffer[4096];
  // When the program ends, reading from its terminal gives an error instead of the end of file.
  for (ssize_t n = 0; (n = ::read(terminal, buffer, sizeof buffer)) > 0;)
    for (ssize_t k = 0; k < n; ++k)
      if (buffer[k] != '\r') out += buffer[k];
  ::close(terminal);
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, out, content_of(scratch.file("err"))};
}

}  // namespace floc::test
