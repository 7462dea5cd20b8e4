#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "floc/io/transient_file.h"

namespace floc {

/// Owns a file descriptor.
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
  /// Closes it now, to learn of errors that only show then.
  bool close();

 private:
  int fd_;
};

/// A new, empty file in the directory of temporary files, removed at the end.
class TemporaryFile {
 public:
  /// @throws IoError with the system's words if it cannot be made
  TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return name_->path(); }
  int descriptor() const { return descriptor_.get(); }

 private:
  std::optional<TransientFile> name_;
  Descriptor descriptor_;
};

/// Writes at the present position. @return false with errno where the system refuses
bool write_all(int fd, std::string_view bytes);

}  // namespace floc
