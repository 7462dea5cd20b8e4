#pragma once

#include <dirent.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/kill_and_resume.h"

namespace floc::test {

/// Campaign of the small scene with two friction coefficients, two rolling resistances and three seeds: twelve
/// runs that take a second each.
inline std::string small_campaign() {
  return R"([campaign]
scene = "small.toml"
seeds = "1..3"
[grid]
contact.friction.coefficient = [0.2, 0.5]
contact.rolling.coefficient = [0.005, 0.01]
[[collect]]
table = "path"
columns = ["phi", "z"]
[[collect]]
table = "moduli"
columns = ["B", "n_negative"]
states = {branch = "load", P_star = [0.1, 1.0]}
[[collect]]
table = "compare"
columns = ["kept_share"]
before = {step = 1}
[[fit]]
law = "consolidation"
[[reference]]
of = "phi"
when = {contact.friction.coefficient = 0.5}
state = {branch = "load", P_star = 1.0}
value = 0.5
error = 0.004
samples = 4
source = "nobody, too loose"
[[reference]]
of = "z"
state = "last"
value = 3.0
error = 2.0
source = "nobody, with a large error"
)";
}

/// Returns whether snakemake is installed (.ci/deps installs it).
inline bool has_snakemake() {
  return std::system("command -v snakemake >/dev/null 2>&1") == 0;
}

/// Starts snakemake in a directory. The output of snakemake goes to the file DIR.snakemake beside the directory.
/// @return process id of snakemake
inline pid_t start_snakemake(const std::string& directory, const std::string& arguments) {
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string command = "exec snakemake " + arguments + " >'" + directory + ".snakemake' 2>&1";
    if (::chdir(directory.c_str()) == 0) ::execl("/bin/bash", "bash", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  return child;
}

/// Runs snakemake and waits for its end.
/// @return exit code of snakemake, with its messages in `out`
inline Outcome snakemake(const std::string& directory, const std::string& arguments = "--cores 2") {
  const int status = wait_for(start_snakemake(directory, arguments));
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(directory + ".snakemake"), ""};
}

/// Returns the processes that work in `directory` and whose arguments, joined by spaces, contain `text`.
inline std::vector<pid_t> processes_in(const std::string& directory, const std::string& text) {
  namespace fs = std::filesystem;
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::error_code gone;
    const fs::path place = fs::read_symlink(entry.path() / "cwd", gone);
    if (gone || place != fs::canonical(directory)) continue;
    std::string line = content_of((entry.path() / "cmdline").string());
    for (char& c : line)
      if (c == '\0') c = ' ';
    if (line.find(text) != std::string::npos) found.push_back(static_cast<pid_t>(std::stoi(name)));
  }
  return found;
}

}  // namespace floc::test
