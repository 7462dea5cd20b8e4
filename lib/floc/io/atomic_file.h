#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "floc/base/error.h"
#include "floc/io/descriptor.h"
#include "floc/io/transient_file.h"

namespace floc {

/// Replaces the content of a file atomically. The content is written to `path` + ".part"; commit() syncs this file,
/// renames it to `path` and syncs the directory. After an interruption at any moment, even a power cut, `path` holds
/// either the whole old content or the whole new content. Output to a device, to a pipe or, for "-", to standard output
/// is first collected in a temporary file.
class AtomicFile {
 public:
  /// Opens the file that collects the content. @param path  file to be replaced, or "-" for standard output
  /// @throws InputError for an empty path, or the path of a directory
  /// @throws IoError with the message of the system if nothing can be written there
  explicit AtomicFile(std::string path);
  /// Removes the ".part" file unless commit() has renamed it. Without commit(), `path` keeps its old content.
  ~AtomicFile() = default;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Path of the file that holds the content before commit(). Other code may write to this file as well.
  const std::string& working_path() const { return temporary_ ? temporary_->path() : part_->path(); }
  /// File descriptor of the file working_path(), open for reading and writing.
  int descriptor() const { return temporary_ ? temporary_->descriptor() : opened_.get(); }

  /// Appends bytes to the content. @throws IoError if they cannot be written
  void append(std::string_view bytes);

  /// Replaces the file `path` by the content collected so far or, if `path` is a stream, writes the content to it.
  /// @throws IoError with the message of the system if the content cannot be written
  void commit();

  /// Returns the error for a `path` that cannot be written. @param error  errno of the call that failed
  IoError cannot_be_written(int error) const;

 private:
  std::string path_;
  std::unique_ptr<TemporaryFile> temporary_;
  std::optional<TransientFile> part_;  ///< the ".part" file, which commit() renames
  Descriptor opened_;
};

/// Replaces the content of a file by `bytes` atomically (see AtomicFile). If `path` is a stream, the bytes are written
/// to it directly, without a temporary file.
/// @throws InputError, IoError under the conditions of AtomicFile
void write_bytes_atomically(const std::string& path, std::string_view bytes);

}  // namespace floc
