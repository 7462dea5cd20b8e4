#include "floc/io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool valid() const { return fd_ >= 0; }
  int get() const { return fd_; }
  /// Closes now, to learn of errors that only show then.
  bool close() {
    const int fd = fd_;
    fd_ = -1;
    return ::close(fd) == 0;
  }

 private:
  int fd_;
};

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// Makes the rename itself durable. Some file systems cannot sync a directory; they order renames themselves.
bool sync_directory_of(const std::string& path) {
  std::filesystem::path directory = std::filesystem::path(path).parent_path();
  if (directory.empty()) directory = ".";
  const Descriptor fd(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!fd.valid()) return errno == EACCES;
  return ::fsync(fd.get()) == 0 || errno == EINVAL || errno == ENOTSUP;
}

IoError cannot_be_written(const std::string& path, int error) {
  return {path, std::string("cannot be written: ") + std::strerror(error != 0 ? error : EIO)};
}

/// What cannot be replaced by a file of its name: stdout, a device, a pipe.
bool is_stream(const std::string& path) {
  std::error_code unknown;
  return path == "-" ||
         (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown) &&
          !std::filesystem::is_directory(path, unknown));
}

void write_to_stream(const std::string& path, std::string_view bytes) {
  if (path == "-") {
    std::fflush(stdout);  // what the program has said before comes first
    if (!write_all(STDOUT_FILENO, bytes)) throw cannot_be_written("standard output", errno);
    return;
  }
  Descriptor fd(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!fd.valid() || !write_all(fd.get(), bytes) || !fd.close()) throw cannot_be_written(path, errno);
}

}  // namespace

void write_bytes_atomically(const std::string& path, std::string_view bytes) {
  if (path.empty()) throw InputError("\"\"", "expected the name of a file to write, and it is empty");
  if (is_stream(path)) return write_to_stream(path, bytes);
  const std::string part = path + ".part";
  Descriptor fd(::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!fd.valid()) throw cannot_be_written(path, errno);
  const bool written = write_all(fd.get(), bytes) && ::fsync(fd.get()) == 0 && fd.close();
  if (!written || std::rename(part.c_str(), path.c_str()) != 0) {
    const int error = errno;
    ::unlink(part.c_str());
    throw cannot_be_written(path, error);
  }
  if (!sync_directory_of(path)) throw IoError(path, std::string("cannot be synced: ") + std::strerror(errno));
}

}  // namespace floc
