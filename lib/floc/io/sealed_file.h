#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "floc/io/atomic_file.h"
#include "floc/io/descriptor.h"

namespace floc {

/// Size, in bytes, of the seal of a state file. A state file is an HDF5 file followed by a seal, which contains the
/// SHA-256 of all bytes before it. The HDF5 library ignores bytes after the end of the HDF5 content, so every program
/// that reads HDF5 can open a state file. floc verifies the seal first, because a damaged HDF5 file can crash the
/// library.
inline constexpr std::size_t kSealSize = 80;

/// Returns the text of the seal of a state file.
/// @param sha256  SHA-256 of all bytes before the seal
std::string seal_of(const std::string& sha256);

/// Computes the seal of the content of a file and appends it to the file. @throws IoError if the seal cannot be written
void append_seal(AtomicFile& file);

/// A state file whose seal (checksum) has been verified. The path may also name a pipe or be "-" (standard input).
class SealedFile {
 public:
  /// Verifies the seal. @throws InputError naming `path` if the file cannot be read, if the seal is missing (because
  /// the file is truncated or was not written by floc), or if the content does not match the seal
  explicit SealedFile(const std::string& path);

  /// Path of the file that was verified: the given path or, for a pipe or standard input, the path of a temporary copy.
  const std::string& content_path() const { return copy_ ? copy_->path() : path_; }

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> copy_;
};

}  // namespace floc
