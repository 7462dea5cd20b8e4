#pragma once

#include <cstdint>
#include <string>

namespace floc {

/// Locks a directory for this process until the object is destroyed, so that no other process writes into it. The
/// lock is an advisory one (flock) on a file in the directory; the system releases it when the process ends, in
/// whatever way.
class DirectoryLock {
 public:
  /// Name of the lock file.
  static constexpr const char* kName = "run.lock";

  /// Locks the directory.
  /// @throws InputError naming the process and the host that hold the directory
  /// @throws IoError if the lock file cannot be made
  explicit DirectoryLock(const std::string& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// Whether the path still leads to the locked directory. The directory may have been renamed or removed, and
  /// another one may have its name.
  bool is_held() const;
  /// Checks is_held() before files are written into the directory. @throws IoError if it is not held
  void require_held() const;

 private:
  std::string directory_;
  std::string path_;
  std::uint64_t device_ = 0, inode_ = 0;  ///< identity of the locked directory
  int file_ = -1;
};

/// Treatment of a directory of a run that already exists.
enum class Existing { refuse, resume, overwrite };

/// Makes a directory for one run or for the runs of an ensemble, unless it exists, and locks it.
class ClaimedDirectory {
 public:
  /// @param runs  "run" or "runs": word for the content of the directory in messages
  /// @throws InputError if the path is empty or not a directory, if another process holds the directory, or if it is
  /// not empty and `existing` is refuse
  ClaimedDirectory(const std::string& path, Existing existing, const std::string& runs);

  /// See DirectoryLock.
  bool is_held() const { return lock_.is_held(); }
  void require_held() const { lock_.require_held(); }

 private:
  DirectoryLock lock_;
};

}  // namespace floc
