#include "floc/base/read_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "floc/base/error.h"

namespace floc {
namespace {

std::string read_all(const std::string& place, std::FILE* file) {
  std::string bytes;
  char buffer[1 << 16];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, file)) bytes.append(buffer, n);
  // A directory opens, and fails only when it is read.
  if (std::ferror(file))
    throw InputError(place, errno == EISDIR ? "is a directory, expected a file" : std::strerror(errno));
  return bytes;
}

}  // namespace

std::string read_file(const std::string& path) {
  errno = 0;
  if (path == "-") return read_all("stdin", stdin);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw InputError(path, std::strerror(errno));
  return read_all(path, file.get());
}

}  // namespace floc
