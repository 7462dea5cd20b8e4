#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "floc/io/atomic_file.h"
#include "floc/io/descriptor.h"

namespace floc {

/// A state file is an HDF5 file followed by a seal: 80 bytes with the SHA-256 of all bytes before them. HDF5
/// ignores what follows its own end of file, so every reader of HDF5 opens it; floc looks at the seal first,
/// because a damaged HDF5 file can crash the library instead of failing.
inline constexpr std::size_t kSealSize = 80;

/// @param sha256  of all that comes before the seal
std::string seal_of(const std::string& sha256);

/// Appends the seal to what a file holds so far. @throws IoError
void append_seal(AtomicFile& file);

/// A sealed file that is whole, open for reading. It may also come through a pipe, or from stdin for "-".
class SealedFile {
 public:
  /// @throws InputError naming `path` if it cannot be read, or if the seal is missing (truncated, not written
  ///         by floc) or does not match
  explicit SealedFile(const std::string& path);

  /// Path of the file that was checked: the one given, or a copy of what came through a pipe.
  const std::string& content_path() const { return copy_ ? copy_->path() : path_; }

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> copy_;
};

}  // namespace floc
