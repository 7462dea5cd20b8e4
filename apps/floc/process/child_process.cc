#include "process/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>

#include "floc/base/error.h"
#include "process/command.h"

namespace floc {
namespace {

volatile std::sig_atomic_t g_signal = 0;
volatile std::sig_atomic_t g_child = 0;

void pass_on(int signal) {
  g_signal = signal;
  if (g_child > 0) ::kill(g_child, SIGTERM);
}

/// Redirects the standard stream with file descriptor `stream` to a file; does nothing if `file` is empty.
bool redirect(const std::string& file, int flags, int stream) {
  if (file.empty()) return true;
  const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | flags, 0666);
  return opened >= 0 && ::dup2(opened, stream) >= 0;
}

[[noreturn]] void become(const std::vector<char*>& argv, const ChildOptions& options, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kFailure);
  if (!redirect(options.log, options.append ? O_APPEND : O_TRUNC, STDERR_FILENO)) ::_exit(kFailure);
  if (!redirect(options.output, O_TRUNC, STDOUT_FILENO)) ::_exit(kFailure);
  if (!options.directory.empty() && ::chdir(options.directory.c_str()) != 0) ::_exit(kFailure);
  ::execv(argv.front(), argv.data());
  ::_exit(kFailure);
}

}  // namespace

std::string this_program() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

pid_t start_floc(const std::vector<std::string>& arguments, const ChildOptions& options) {
  std::vector<std::string> words = {this_program()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0)
    throw IoError("floc " + arguments.front(), "no child process could be started for this command");
  if (child == 0) become(argv, options, parent);
  return child;
}

int exit_code_of(int status) {
  constexpr int kSignals = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignals + WTERMSIG(status);
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return exit_code_of(status);
}

void pass_signals_on() {
  std::signal(SIGINT, pass_on);
  std::signal(SIGTERM, pass_on);
}

bool was_signalled() {
  return g_signal != 0;
}

int run_floc(const std::vector<std::string>& arguments, const ChildOptions& options) {
  const pid_t child = start_floc(arguments, options);
  g_child = child;
  // A signal that arrived before g_child was set was not passed on by the handler, so it is passed on here.
  if (was_signalled()) ::kill(child, SIGTERM);
  const int code = wait_for(child);
  g_child = 0;
  return code;
}

}  // namespace floc
