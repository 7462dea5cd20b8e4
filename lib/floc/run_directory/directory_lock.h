#pragma once

#include <cstdint>
#include <string>

namespace floc {

/// Locks a directory for this process until the object is destroyed, so that no other process of floc writes into it.
/// The lock is an advisory lock (flock) on a file in the directory. The operating system releases it when the process
/// ends, even if the process is killed.
class DirectoryLock {
 public:
  /// Name of the lock file.
  static constexpr const char* kName = "run.lock";

  /// Locks the directory.
  /// @throws InputError that names the process and the host that have locked the directory
  /// @throws IoError if the lock file cannot be created
  explicit DirectoryLock(const std::string& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// Whether the path still leads to the locked directory. It does not if the directory has been renamed or removed,
  /// even if another directory now has its name.
  bool is_held() const;
  /// Checks that the path still leads to the locked directory, before files are written into it.
  /// @throws IoError if it does not
  void require_held() const;

 private:
  std::string directory_;
  std::string path_;
  std::uint64_t device_ = 0, inode_ = 0;  ///< identity of the locked directory
  int file_ = -1;
};

/// Treatment of an existing directory with files of a run: report an error, continue the run, or replace it.
enum class Existing { refuse, resume, overwrite };

/// Creates a directory for one run or for the runs of an ensemble, unless it exists, and locks it.
class ClaimedDirectory {
 public:
  /// @param runs  "run" or "runs": word for the content of the directory in messages
  /// @throws InputError if the path is empty or not a directory, if another process has locked the directory, or if the
  /// directory is not empty and `existing` is Existing::refuse
  ClaimedDirectory(const std::string& path, Existing existing, const std::string& runs);

  /// Whether the path still leads to the locked directory, see DirectoryLock::is_held().
  bool is_held() const { return lock_.is_held(); }
  void require_held() const { lock_.require_held(); }

 private:
  DirectoryLock lock_;
};

}  // namespace floc
