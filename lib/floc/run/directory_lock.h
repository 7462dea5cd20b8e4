#pragma once

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

 private:
  std::string path_;
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

 private:
  DirectoryLock lock_;
};

}  // namespace floc
