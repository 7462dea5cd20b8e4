#include "floc/io/descriptor.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "floc/base/error.h"

namespace floc {

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

bool Descriptor::close() {
  return ::close(std::exchange(fd_, -1)) == 0;
}

TemporaryFile::TemporaryFile() : descriptor_(-1) {
  std::string path = (std::filesystem::temp_directory_path() / "floc-XXXXXX").string();
  descriptor_ = Descriptor(::mkostemp(path.data(), O_CLOEXEC));
  if (!descriptor_.valid()) throw IoError(path, std::string("cannot be written: ") + std::strerror(errno));
  name_.emplace(std::move(path));
}

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace floc
