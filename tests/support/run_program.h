#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "support/places.h"
#include "support/scratch_directory.h"

namespace floc::test {

/// Result of running a program.
struct Outcome {
  int code;         ///< exit code, -1 if the program did not exit by itself
  std::string out;  ///< stdout
  std::string err;  ///< stderr
};

inline std::string content_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

/// Runs floc with arguments in the syntax of a shell, in `directory`, with `input` on its stdin.
inline Outcome run_floc(const std::string& arguments, const std::string& directory = ".",
                        const std::string& input = "") {
  const ScratchDirectory scratch;
  write_text(scratch.file("in"), input);
  const std::string command = "cd '" + directory + "' && " + floc_program() + " " + arguments + " <'" +
                              scratch.file("in") + "' >'" + scratch.file("out") + "' 2>'" +
                              scratch.file("err") + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(scratch.file("out")),
          content_of(scratch.file("err"))};
}

}  // namespace floc::test
