#pragma once

#include <string>

namespace floc {

/// A new directory in the system's directory for temporary files. The destructor removes it with all files in it.
class ScratchDirectory {
 public:
  /// @throws IoError if the directory cannot be made
  ScratchDirectory();
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace floc
