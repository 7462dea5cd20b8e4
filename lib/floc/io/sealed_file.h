#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "floc/io/atomic_file.h"
#include "floc/io/descriptor.h"

namespace floc {

/// Size of the seal of a state file (bytes). A state file is an HDF5 file followed by a seal, which holds the SHA-256
/// of all bytes before it. HDF5 ignores what follows its own end of file, so every reader of HDF5 opens a state file.
/// floc checks the seal first, because a damaged HDF5 file can crash the library.
inline constexpr std::size_t kSealSize = 80;

/// Returns the text of a seal. @param sha256  checksum of all bytes before the seal
std::string seal_of(const std::string& sha256);

/// Appends the seal to the content of a file. @throws IoError if it cannot be written
void append_seal(AtomicFile& file);

/// A sealed file whose checksum was verified, open for reading. It may also come through a pipe, or from stdin for
/// "-".
class SealedFile {
 public:
  /// @throws InputError naming `path` if it cannot be read, or if the seal is missing (truncated, not written
  ///         by floc) or does not match
  explicit SealedFile(const std::string& path);

  /// Path of the verified file: the given path, or the path of a copy of what came through a pipe.
  const std::string& content_path() const { return copy_ ? copy_->path() : path_; }

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> copy_;
};

}  // namespace floc
