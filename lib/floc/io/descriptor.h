#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "floc/io/transient_file.h"

namespace floc {

/// Owns a file descriptor of the operating system; the destructor closes it.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }

  bool valid() const { return fd_ >= 0; }
  int get() const { return fd_; }
  /// Closes the file descriptor. The system reports some errors of earlier writes only when the descriptor is closed.
  /// @return false, with errno set, if the system reports an error
  bool close();

 private:
  int fd_;
};

/// Owns a temporary file. The constructor creates an empty file in the system's directory for temporary files; the
/// destructor removes the file.
class TemporaryFile {
 public:
  /// Creates the file. @throws IoError with the error message of the system if the file cannot be created
  TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return name_->path(); }
  int descriptor() const { return descriptor_.get(); }

 private:
  std::optional<TransientFile> name_;
  Descriptor descriptor_;
};

/// Writes all of `bytes` at the current position of the file descriptor `fd`.
/// @return false, with errno set, if the system reports an error
bool write_all(int fd, std::string_view bytes);

}  // namespace floc
