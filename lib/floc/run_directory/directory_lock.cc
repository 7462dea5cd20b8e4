#include "floc/run_directory/directory_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "floc/base/error.h"

namespace floc {
namespace fs = std::filesystem;
namespace {

/// Number of attempts to lock a directory, and pause between two attempts (microseconds). One attempt is not enough:
/// the processes of a killed ensemble may release their locks slightly after the ensemble has ended.
constexpr int kAttempts = 50;
constexpr useconds_t kPause = 10'000;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

/// Returns the name of the owner of the lock for a message: the text that the owner has written into the lock file, or
/// "another process" if the file is still empty.
std::string holder(int file) {
  std::array<char, 512> text{};
  const ssize_t n = ::pread(file, text.data(), text.size() - 1, 0);
  return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : "another process";
}

/// Whether the path of the lock file still refers to the opened file. The answer is false if the previous owner of the
/// lock has removed the lock file; every owner removes the file before it releases the lock.
bool is_current(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

/// Whether `error`, the errno of a failed flock(), means that the file system does not support locks. A directory on
/// such a file system is used without a lock.
bool has_no_locks(int error) {
  return error == ENOTSUP || error == EOPNOTSUPP || error == ENOSYS || error == ENOLCK;
}

/// Checks that a directory is empty, unless an existing run in the directory may be continued or replaced.
/// @param runs  word for the content of the directory in messages, "run" or "runs"
/// @throws InputError if the directory contains other files than the lock file
void require_empty(const std::string& path, Existing existing, const std::string& runs) {
  if (existing != Existing::refuse || !fs::is_directory(path)) return;
  for (const auto& entry : fs::directory_iterator(path))
    if (entry.path().filename() != DirectoryLock::kName)
      throw InputError(path, fmt::format("this directory is not empty: give --resume to continue the {} in it, "
                                         "or --overwrite to replace {}",
                                         runs, runs == "run" ? "it" : "them"));
}

/// Prepares a directory for a lock: checks its path, and creates the directory if it does not exist. Returns the path.
/// @param runs  word for the content of the directory in messages, "run" or "runs"
const std::string& prepared(const std::string& path, Existing existing, const std::string& runs) {
  if (path.empty())
    throw InputError("\"\"", "the name of the directory is empty: expected the name of a directory");
  if (path == "-") throw InputError(path, "this name means standard output: expected the name of a directory");
  if (fs::exists(path) && !fs::is_directory(path))
    throw InputError(path, "this is a file: expected a directory");
  // If a lock file exists, another process may use the directory. In this case the directory is not checked here: a
  // later attempt to lock it fails with a message that names the other process.
  if (!fs::exists(fs::path(path) / DirectoryLock::kName)) require_empty(path, existing, runs);
  std::error_code failed;
  fs::create_directories(path, failed);
  if (failed) throw IoError(path, "the directory cannot be created: " + failed.message());
  return path;
}

}  // namespace

DirectoryLock::DirectoryLock(const std::string& directory)
    : directory_(directory), path_((fs::path(directory) / kName).string()) {
  for (int attempt = 1;; ++attempt) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw IoError(path_, std::string("this file cannot be written: ") + std::strerror(errno));
    const bool locked = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
    if (!locked && has_no_locks(errno)) break;
    if (locked && is_current(file_, path_)) break;
    const std::string by = holder(file_);
    ::close(file_);
    file_ = -1;
    if (attempt < kAttempts)
      ::usleep(locked ? 0 : kPause);
    else
      throw InputError(directory, "another run is writing into this directory (" + by +
                                      "): expected a directory that no other run uses");
  }
  struct stat held {};
  if (::stat(directory.c_str(), &held) == 0) device_ = held.st_dev, inode_ = held.st_ino;
  const std::string text = fmt::format("process {} on {}", ::getpid(), host_name());
  // The text in the lock file is used only in messages, so a failure to write it is ignored. If the disk is full,
  // saving a state reports the error.
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, text.data(), text.size(), 0) < 0) return;
}

DirectoryLock::~DirectoryLock() {
  if (file_ < 0) return;
  // If another process has replaced the lock file by its own, that file is not removed.
  if (is_current(file_, path_)) ::unlink(path_.c_str());
  ::close(file_);
}

bool DirectoryLock::is_held() const {
  struct stat named {};
  const bool found = ::stat(directory_.c_str(), &named) == 0;
  // If the lock file has been removed, the directory still belongs to this process. If another lock file has replaced
  // it, the directory belongs to another process.
  return found && named.st_dev == device_ && named.st_ino == inode_ &&
         (is_current(file_, path_) || ::access(path_.c_str(), F_OK) != 0);
}

void DirectoryLock::require_held() const {
  if (is_held()) return;
  throw IoError(directory_,
                "this is no longer the directory of the run: it has been renamed or removed while the run used "
                "it. The states saved so far are in the renamed directory; to continue the run, give that "
                "directory with --resume");
}

ClaimedDirectory::ClaimedDirectory(const std::string& path, Existing existing, const std::string& runs)
    : lock_(prepared(path, existing, runs)) {
  // The directory is checked once more, because another process may have written files into it just before it was
  // locked.
  require_empty(path, existing, runs);
}

}  // namespace floc
