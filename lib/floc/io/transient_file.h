#pragma once

#include <string>

namespace floc {

/// The name of a file that is removed at the end of the scope, or when a signal ends the program, unless it is kept.
class TransientFile {
 public:
  /// @param path  of a file that is there or is going to be
  explicit TransientFile(std::string path);
  ~TransientFile();
  TransientFile(const TransientFile&) = delete;
  TransientFile& operator=(const TransientFile&) = delete;

  const std::string& path() const { return path_; }
  /// The file has become one that stays.
  void keep();

 private:
  std::string path_;
  bool kept_ = false;
};

/// From here on SIGINT, SIGTERM and SIGHUP remove what is transient before they end the program; one that the caller
/// had ignored stays so.
void remove_transient_files_on_signals();

}  // namespace floc
