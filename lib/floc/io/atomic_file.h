#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "floc/base/error.h"
#include "floc/io/descriptor.h"
#include "floc/io/transient_file.h"

namespace floc {

/// Replaces the content of the file `path` atomically: at any moment, even after a power cut, `path` contains either
/// its whole old content or its whole new content. The new content is written to the file `path` + ".part"; commit()
/// syncs this file, renames it to `path` and syncs the directory. If `path` is a stream (a device, a pipe or "-",
/// standard output), the new content is collected in a temporary file, and commit() copies it to the stream.
class AtomicFile {
 public:
  /// Opens the ".part" file or, if `path` is a stream, the temporary file.
  /// @param path  file to be replaced, or stream; "-" is standard output
  /// @throws InputError if the path is empty or the path of a directory
  /// @throws IoError with the error message of the system if the ".part" or temporary file cannot be opened for writing
  explicit AtomicFile(std::string path);
  /// Removes the ".part" file unless commit() has renamed it. Without commit(), `path` keeps its old content.
  ~AtomicFile() = default;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Path of the ".part" or temporary file, which contains the new content until commit(). Other code, such as the HDF5
  /// library, may write to this file directly.
  const std::string& working_path() const { return temporary_ ? temporary_->path() : part_->path(); }
  /// File descriptor of the file at working_path(), open for reading and writing.
  int descriptor() const { return temporary_ ? temporary_->descriptor() : opened_.get(); }

  /// Appends bytes to the new content.
  /// @throws IoError if the bytes cannot be written
  void append(std::string_view bytes);

  /// Replaces the file `path` by the new content or, if `path` is a stream, writes the new content to the stream.
  /// @throws IoError with the error message of the system if the new content cannot be written
  void commit();

  /// Returns an exception with the message that `path` cannot be written.
  /// @param error  errno of the system call that failed
  IoError cannot_be_written(int error) const;

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> temporary_;
  /// The ".part" file, which commit() renames to `path`; absent if `path` is a stream.
  std::optional<TransientFile> part_;
  Descriptor opened_;
};

/// Replaces the content of the file `path` by `bytes` atomically (see AtomicFile). If `path` is a stream (a device, a
/// pipe or "-", standard output), the bytes are written to the stream directly, without a temporary file.
/// @throws InputError, IoError under the conditions of AtomicFile
void write_bytes_atomically(const std::string& path, std::string_view bytes);

}  // namespace floc
