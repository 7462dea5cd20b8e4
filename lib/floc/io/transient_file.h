#pragma once

#include <string>

namespace floc {

/// A temporary file. Unless keep() has been called, the file is removed by the destructor of this object, or when a
/// signal ends the program.
class TransientFile {
 public:
  /// @param path  path of the file, which exists already or will be created by the caller
  explicit TransientFile(std::string path);
  ~TransientFile();
  TransientFile(const TransientFile&) = delete;
  TransientFile& operator=(const TransientFile&) = delete;

  const std::string& path() const { return path_; }
  /// Keeps the file: neither the destructor nor a signal removes it any more.
  void keep();

 private:
  std::string path_;
  bool kept_ = false;
};

/// Installs signal handlers that remove all transient files before SIGINT, SIGTERM or SIGHUP ends the program. A signal
/// that the program ignores stays ignored.
void remove_transient_files_on_signals();

}  // namespace floc
