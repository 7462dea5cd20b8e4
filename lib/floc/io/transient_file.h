#pragma once

#include <string>

namespace floc {

/// The name of a file that is removed at the end of the scope, or when a signal ends the program, unless kept.
class TransientFile {
 public:
  /// @param path  of a file that exists or is going to
  explicit TransientFile(std::string path);
  ~TransientFile();
  TransientFile(const TransientFile&) = delete;
  TransientFile& operator=(const TransientFile&) = delete;

  const std::string& path() const { return path_; }
  /// Makes the file one that stays.
  void keep();

 private:
  std::string path_;
  bool kept_ = false;
};

/// From here on SIGINT, SIGTERM and SIGHUP remove transient files before they end the program; a signal that
/// the caller had ignored stays ignored.
void remove_transient_files_on_signals();

}  // namespace floc
