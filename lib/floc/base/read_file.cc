#include "floc/base/read_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/gzip_stream.h"

namespace floc {
namespace {

constexpr std::size_t kPiece = 1 << 16;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// @throws InputError if the file cannot be opened
File open_file(const std::string& path) {
  errno = 0;
  File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw InputError(path, std::strerror(errno));
  return file;
}

/// @throws InputError if reading the file has failed
void require_read(const std::string& place, std::FILE* file) {
  // A directory can be opened like a file. The error occurs only when the directory is read.
  if (std::ferror(file))
    throw InputError(place,
                     errno == EISDIR ? "this is a directory, but a file is expected" : std::strerror(errno));
}

void read_all(const std::string& place, std::FILE* file, const std::function<void(std::string_view)>& take) {
  std::vector<char> buffer(kPiece);
  std::optional<GzipStream> gzip;
  bool first = true;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file)) {
    const std::string_view piece(buffer.data(), n);
    if (std::exchange(first, false) && is_gzip(piece)) gzip.emplace(place);
    if (gzip)
      gzip->pass(piece, take);
    else
      take(piece);
  }
  if (gzip) gzip->finish();
  require_read(place, file);
}

}  // namespace

std::string read_file(const std::string& path) {
  std::string bytes;
  read_pieces(path, [&](std::string_view piece) { bytes.append(piece); });
  return bytes;
}

std::string read_beginning(const std::string& path, std::size_t most) {
  if (path == "-") return "";
  const File file = open_file(path);
  std::string bytes(kPiece, '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  require_read(path, file.get());
  if (is_gzip(bytes)) {
    std::string inflated;
    GzipStream(path).pass(bytes, [&](std::string_view piece) { inflated.append(piece); });
    bytes = std::move(inflated);
  }
  bytes.resize(std::min(bytes.size(), most));
  return bytes;
}

void read_pieces(const std::string& path, const std::function<void(std::string_view)>& take) {
  errno = 0;
  if (path == "-") return read_all("stdin", stdin, take);
  read_all(path, open_file(path).get(), take);
}

bool is_hdf5(const std::string& path) {
  constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
  return read_beginning(path, kSignature.size()) == kSignature;
}

}  // namespace floc
