#pragma once

#include <string>

namespace floc {

/// A file that is removed at the end of the scope, or when a signal ends the program, unless it is kept.
class TransientFile {
 public:
  /// @param path  file that exists or will be made
  explicit TransientFile(std::string path);
  ~TransientFile();
  TransientFile(const TransientFile&) = delete;
  TransientFile& operator=(const TransientFile&) = delete;

  const std::string& path() const { return path_; }
  /// Keeps the file: it is no longer removed.
  void keep();

 private:
  std::string path_;
  bool kept_ = false;
};

/// Installs handlers by which SIGINT, SIGTERM and SIGHUP remove transient files before they end the program. A signal
/// that the caller ignores stays ignored.
void remove_transient_files_on_signals();

}  // namespace floc
