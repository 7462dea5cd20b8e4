#include "floc/io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>

#include "floc/base/read_file.h"

namespace floc {
namespace {

/// Syncs the directory of the file `path` to the disk. Afterwards, a renamed file in this directory keeps its new name
/// even after a power cut. It is not an error if the directory cannot be read or does not support syncing.
/// @return false, with errno set, if the system reports any other error
bool sync_directory_of(const std::string& path) {
  std::filesystem::path directory = std::filesystem::path(path).parent_path();
  if (directory.empty()) directory = ".";
  const Descriptor fd(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!fd.valid()) return errno == EACCES;
  return ::fsync(fd.get()) == 0 || errno == EINVAL || errno == ENOTSUP;
}

/// Whether a path names a stream: standard output ("-"), a device or a pipe. Content is written to a stream directly,
/// because a temporary file cannot be renamed to a stream.
bool is_stream(const std::string& path) {
  std::error_code unknown;
  return path == "-" ||
         (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown) &&
          !std::filesystem::is_directory(path, unknown));
}

IoError refused(const std::string& path, int error) {
  return {path == "-" ? "standard output" : path,
          std::string("cannot be written: ") + std::strerror(error != 0 ? error : EIO)};
}

/// Writes content to the stream `path`.
/// @param content  function that produces the content piece by piece, and passes each piece to its argument, a function
/// that writes the piece to the stream
void write_to_stream(const std::string& path,
                     const std::function<void(const std::function<void(std::string_view)>&)>& content) {
  std::fflush(stdout);  // so that earlier output of the program precedes the content
  Descriptor stream(path == "-" ? ::dup(STDOUT_FILENO) : ::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!stream.valid()) throw refused(path, errno);
  content([&](std::string_view piece) {
    if (!write_all(stream.get(), piece)) throw refused(path, errno);
  });
  if (!stream.close()) throw refused(path, errno);
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), opened_(-1) {
  if (path_.empty()) throw InputError("\"\"", "the name of the file to write is empty");
  if (is_stream(path_)) {
    temporary_ = std::make_unique<TemporaryFile>();
    return;
  }
  if (std::error_code unknown; std::filesystem::is_directory(path_, unknown))
    throw InputError(path_, "this path is a directory: expected the name of a file to write");
  const std::string part = path_ + ".part";
  opened_ = Descriptor(::open(part.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!opened_.valid()) throw cannot_be_written(errno);
  part_.emplace(part);
}

IoError AtomicFile::cannot_be_written(int error) const {
  return refused(path_, error);
}

void AtomicFile::append(std::string_view bytes) {
  if (::lseek(descriptor(), 0, SEEK_END) < 0 || !write_all(descriptor(), bytes)) throw cannot_be_written(errno);
}

void AtomicFile::commit() {
  if (temporary_)
    return write_to_stream(path_, [&](const auto& write) { read_pieces(temporary_->path(), write); });
  if (::fsync(descriptor()) != 0 || !opened_.close() || std::rename(part_->path().c_str(), path_.c_str()) != 0)
    throw cannot_be_written(errno);
  part_->keep();
  if (!sync_directory_of(path_))
    throw IoError(
        path_, std::string("the directory of this file cannot be synced to the disk: ") + std::strerror(errno));
}

void write_bytes_atomically(const std::string& path, std::string_view bytes) {
  if (is_stream(path)) return write_to_stream(path, [&](const auto& write) { write(bytes); });
  AtomicFile file(path);
  file.append(bytes);
  file.commit();
}

}  // namespace floc
