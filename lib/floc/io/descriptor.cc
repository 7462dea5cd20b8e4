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

TemporaryFile::TemporaryFile()
    : path_((std::filesystem::temp_directory_path() / "floc-XXXXXX").string()),
      descriptor_(::mkostemp(path_.data(), O_CLOEXEC)) {
  if (!descriptor_.valid()) throw IoError(path_, std::string("cannot be written: ") + std::strerror(errno));
}

TemporaryFile::~TemporaryFile() {
  ::unlink(path_.c_str());
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
