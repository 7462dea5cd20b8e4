#pragma once

#include <cstdint>
#include <string>

namespace floc {

/// Holds a directory for this process until it is destroyed, so that no other process writes into it: an
/// advisory lock (flock) on a file in it, which the system releases when the process ends, however it ends.
class DirectoryLock {
 public:
  /// The name of the file.
  static constexpr const char* kName = "run.lock";

  /// @throws InputError naming the process and the host that hold the directory
  /// @throws IoError if the file cannot be made
  explicit DirectoryLock(const std::string& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// Whether the path still leads to the directory that is held: it may have been renamed or removed, and another one
  /// may bear its name.
  bool is_held() const;
  /// To be called before files are written into the directory. @throws IoError if it is not held
  void require_held() const;

 private:
  std::string directory_;
  std::string path_;
  std::uint64_t device_ = 0, inode_ = 0;  ///< of the directory that is held
  int file_ = -1;
};

/// What to do with a run's directory that already exists.
enum class Existing { refuse, resume, overwrite };

/// Makes a directory for one run or for the runs of an ensemble, unless it exists, and holds it.
/// @param runs  "run" or "runs", what messages call its content
class ClaimedDirectory {
 public:
  /// @throws InputError if the path is empty or not a directory, if another process holds the directory, or if
  /// it is not empty and nobody asked to resume or overwrite
  ClaimedDirectory(const std::string& path, Existing existing, const std::string& runs);

  /// As DirectoryLock has them.
  bool is_held() const { return lock_.is_held(); }
  void require_held() const { lock_.require_held(); }

 private:
  DirectoryLock lock_;
};

}  // namespace floc
