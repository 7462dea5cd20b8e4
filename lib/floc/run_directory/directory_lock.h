#pragma once

#include <cstdint>
#include <string>

namespace floc {

/// Lock on a directory. As long as this object exists, no other process of floc writes into the directory. The lock is
/// an advisory lock (flock) on a file in the directory. The operating system releases the lock when the process ends,
/// even if the process is killed.
class DirectoryLock {
 public:
  /// Name of the lock file in the directory.
  static constexpr const char* kName = "run.lock";

  /// Locks the directory.
  /// @throws InputError that names the process and the host that have locked the directory
  /// @throws IoError if the lock file cannot be created
  explicit DirectoryLock(const std::string& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// Whether the path of the directory still refers to the locked directory. The answer is false if the directory has
  /// been renamed or removed, even if a new directory has the old name.
  bool is_held() const;
  /// Checks that the path of the directory still refers to the locked directory. This function must be called before
  /// files are written into the directory.
  /// @throws IoError if the path no longer refers to the locked directory
  void require_held() const;

 private:
  std::string directory_;
  std::string path_;
  std::uint64_t device_ = 0, inode_ = 0;  ///< device number and inode number of the locked directory
  int file_ = -1;
};

/// Treatment of a directory that already contains files of a run: report an error (refuse), continue that run (resume),
/// or replace its files (overwrite).
enum class Existing { refuse, resume, overwrite };

/// Locked directory of one run, or of the runs of an ensemble. Only this process writes into the directory. The
/// constructor creates the directory if it does not exist, and locks it.
class ClaimedDirectory {
 public:
  /// @param runs  word that messages use for the content of the directory, "run" or "runs"
  /// @throws InputError if the path is empty or not a directory, if another process has locked the directory, or if the
  /// directory is not empty and `existing` is Existing::refuse
  ClaimedDirectory(const std::string& path, Existing existing, const std::string& runs);

  /// Whether the path of the directory still refers to the locked directory, see DirectoryLock::is_held().
  bool is_held() const { return lock_.is_held(); }
  void require_held() const { lock_.require_held(); }

 private:
  DirectoryLock lock_;
};

}  // namespace floc
