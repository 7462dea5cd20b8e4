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

/// Number of attempts to lock and the pause between two (microseconds): the processes of a killed ensemble end
/// slightly later than the ensemble, so a new run waits for them.
constexpr int kAttempts = 50;
constexpr useconds_t kPause = 10'000;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

/// Returns the text that the holder wrote into the lock file, or "another process" if it has not written yet.
std::string holder(int file) {
  std::array<char, 512> text{};
  const ssize_t n = ::pread(file, text.data(), text.size() - 1, 0);
  return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : "another process";
}

/// Whether the name still leads to the open file: a holder removes the file before it releases the lock.
bool is_current(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

/// Whether an error says that the file system has no locks; a directory there cannot be locked.
bool has_no_locks(int error) {
  return error == ENOTSUP || error == EOPNOTSUPP || error == ENOSYS || error == ENOLCK;
}

/// Checks that a directory for a new run is empty.
/// @throws InputError if it holds more than the lock file
void require_empty(const std::string& path, Existing existing, const std::string& runs) {
  if (existing != Existing::refuse || !fs::is_directory(path)) return;
  for (const auto& entry : fs::directory_iterator(path))
    if (entry.path().filename() != DirectoryLock::kName)
      throw InputError(path,
                       fmt::format("is not empty: give --resume to continue the {} in it or --overwrite to "
                                   "replace {}",
                                   runs, runs == "run" ? "it" : "them"));
}

/// Makes the directory if necessary, and returns its path, which may then be locked.
const std::string& prepared(const std::string& path, Existing existing, const std::string& runs) {
  if (path.empty()) throw InputError("\"\"", "expected the name of a directory, but it is empty");
  if (path == "-") throw InputError(path, "is standard output, expected the name of a directory");
  if (fs::exists(path) && !fs::is_directory(path)) throw InputError(path, "is a file, expected a directory");
  // If the directory is held, the message names the holder.
  if (!fs::exists(fs::path(path) / DirectoryLock::kName)) require_empty(path, existing, runs);
  std::error_code failed;
  fs::create_directories(path, failed);
  if (failed) throw IoError(path, "cannot make the directory: " + failed.message());
  return path;
}

}  // namespace

DirectoryLock::DirectoryLock(const std::string& directory)
    : directory_(directory), path_((fs::path(directory) / kName).string()) {
  for (int attempt = 1;; ++attempt) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw IoError(path_, std::string("cannot be written: ") + std::strerror(errno));
    const bool locked = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
    if (!locked && has_no_locks(errno)) break;
    if (locked && is_current(file_, path_)) break;
    const std::string by = holder(file_);
    ::close(file_);
    file_ = -1;
    if (attempt < kAttempts)
      ::usleep(locked ? 0 : kPause);
    else
      throw InputError(directory,
                       "is being written by " + by + ": expected a directory that no other run writes");
  }
  struct stat held {};
  if (::stat(directory.c_str(), &held) == 0) device_ = held.st_dev, inode_ = held.st_ino;
  const std::string text = fmt::format("process {} on {}", ::getpid(), host_name());
  // The text serves messages only, so a failure to write it is ignored; a full disk shows when a state is written.
  if (::ftruncate(file_, 0) != 0 || ::pwrite(file_, text.data(), text.size(), 0) < 0) return;
}

DirectoryLock::~DirectoryLock() {
  if (file_ < 0) return;
  if (is_current(file_, path_)) ::unlink(path_.c_str());  // unless it belongs to another process
  ::close(file_);
}

bool DirectoryLock::is_held() const {
  struct stat named {};
  const bool found = ::stat(directory_.c_str(), &named) == 0;
  // If only the lock file was removed, the directory is still held; another lock file belongs to another process.
  return found && named.st_dev == device_ && named.st_ino == inode_ &&
         (is_current(file_, path_) || ::access(path_.c_str(), F_OK) != 0);
}

void DirectoryLock::require_held() const {
  if (is_held()) return;
  throw IoError(directory_,
                "is no longer the directory that is being written: that one has been renamed or removed; "
                "expected one that stays in place. What was saved before is where it has gone, and "
                "--resume continues there");
}

ClaimedDirectory::ClaimedDirectory(const std::string& path, Existing existing, const std::string& runs)
    : lock_(prepared(path, existing, runs)) {
  // Another process may have used the directory in the meantime.
  require_empty(path, existing, runs);
}

}  // namespace floc
