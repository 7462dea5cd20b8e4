#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "floc/base/error.h"
#include "floc/io/descriptor.h"
#include "floc/io/transient_file.h"

namespace floc {

/// Replaces the content of a file: it is written to `path` + ".part", which commit() syncs and renames over
/// `path`, then syncs the directory. Whatever happens meanwhile, even a power cut, `path` holds all of the old
/// content or all of the new. Output to a device, to a pipe or, for "-", to standard output is collected in a
/// temporary file first.
class AtomicFile {
 public:
  /// @throws InputError for an empty path, or that of a directory
  /// @throws IoError with the system's words if nothing can be written there
  explicit AtomicFile(std::string path);
  /// The part is removed if it has not been committed: `path` is as it was.
  ~AtomicFile() = default;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Path of the file that holds the content before commit(). Others may write it, too.
  const std::string& working_path() const { return temporary_ ? temporary_->path() : part_->path(); }
  /// Descriptor of the same file, open for reading and writing.
  int descriptor() const { return temporary_ ? temporary_->descriptor() : opened_.get(); }

  /// Adds to the end. @throws IoError
  void append(std::string_view bytes);

  /// @throws IoError with the system's words if that fails
  void commit();

  /// @param error  errno of what failed
  IoError cannot_be_written(int error) const;

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> temporary_;
  std::optional<TransientFile> part_;  ///< to be renamed
  Descriptor opened_;
};

/// The same with bytes that are all there already; what goes to a stream is written at once.
/// @throws InputError, IoError as AtomicFile does
void write_bytes_atomically(const std::string& path, std::string_view bytes);

}  // namespace floc
