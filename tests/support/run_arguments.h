#pragma once

#include <string>
#include <vector>

#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {

/// Runs a program without a shell, so that its arguments may contain any character.
/// @param input  stdin of the program
inline Outcome run_arguments(const std::string& program, const std::vector<std::string>& arguments,
                             const std::string& input = "") {
  const ScratchDirectory scratch;
  write_text(scratch.file("in"), input);
  const auto quoted = [](const std::string& argument) {
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
  };
  std::string command = quoted(program);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  command += " <" + quoted(scratch.file("in")) + " >" + quoted(scratch.file("out")) + " 2>" +
             quoted(scratch.file("err"));
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(scratch.file("out")),
          content_of(scratch.file("err"))};
}

/// Runs floc without a shell.
inline Outcome floc_arguments(const std::vector<std::string>& arguments, const std::string& input = "") {
  return run_arguments(floc_program(), arguments, input);
}

}  // namespace floc::test
