#include "floc/io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/io/state_file.h"
#include "support/scratch_directory.h"
#include "support/states.h"

namespace floc {
namespace {

using test::ScratchDirectory;

int n_files(const std::string& directory) {
  const std::filesystem::directory_iterator files(directory);
  return static_cast<int>(std::distance(begin(files), end(files)));
}

TEST(AtomicFile, ReplacesAFileAndLeavesNoPart) {
  const ScratchDirectory scratch;
  write_bytes_atomically(scratch.file("f"), "old and long");
  write_bytes_atomically(scratch.file("f"), std::string("new\0!", 5));
  EXPECT_EQ(read_file(scratch.file("f")), std::string("new\0!", 5));
  EXPECT_EQ(n_files(scratch.path()), 1);
}

TEST(AtomicFile, IntoNoDirectoryIsAnErrorThatNamesTheFile) {
  const ScratchDirectory scratch;
  write_bytes_atomically(scratch.file("f"), "a file, no directory");
  try {
    write_bytes_atomically(scratch.file("f/g"), "x");
    FAIL();
  } catch (const IoError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(scratch.file("f/g") + ": cannot be written: Not a directory"));
  }
  EXPECT_THROW(write_bytes_atomically(scratch.file("nowhere/g"), "x"), IoError);
}

TEST(AtomicFile, OverADirectoryLeavesTheDirectoryAndNoPart) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch.file("d"));
  EXPECT_THAT([&] { write_bytes_atomically(scratch.file("d"), "x"); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(
                  scratch.file("d") + ": this path is a directory: expected the name of a file")));
  EXPECT_TRUE(std::filesystem::is_directory(scratch.file("d")));
  EXPECT_EQ(n_files(scratch.path()), 1);
}

TEST(AtomicFile, LeavesNoPartWhereASignalEndsTheProgram) {
  const ScratchDirectory scratch;
  write_bytes_atomically(scratch.file("f"), "old");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = ::fork();
    if (child == 0) {
      std::signal(signal, SIG_DFL);
      remove_transient_files_on_signals();
      AtomicFile file(scratch.file("f"));
      file.append("new");
      const AtomicFile printed("-");
      std::raise(signal);
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    EXPECT_EQ(read_file(scratch.file("f")), "old");
    EXPECT_EQ(n_files(scratch.path()), 1);
  }
}

/// Runs `work` in a process whose files can have at most `limit` bytes, which has the effect of a full disk. Returns
/// the exit code of the process.
template <class Work>
int exit_code_with_file_limit(rlim_t limit, const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit size{limit, limit};
    ::setrlimit(RLIMIT_FSIZE, &size);
    ::signal(SIGXFSZ, SIG_IGN);
    ::_exit(work());
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(AtomicFile, OnAFullDiskKeepsTheOldStateAndLeavesNoPart) {
  constexpr int kRefused = 42;
  const ScratchDirectory scratch;
  const std::string path = scratch.file("s.h5");
  State<2> state = test::busy_state<2>();
  write_state(path, state);
  const std::string old = read_file(path);
  state.path.step += 1;
  const int code = exit_code_with_file_limit(4096, [&] {
    try {
      write_state(path, state);
    } catch (const IoError&) {
      return kRefused;
    }
    return 0;
  });
  EXPECT_EQ(code, kRefused);
  EXPECT_EQ(read_file(path), old);
  EXPECT_EQ(n_files(scratch.path()), 1);
}

}  // namespace
}  // namespace floc
