#include "floc/io/sealed_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/base/sha256.h"

namespace floc {
namespace {

constexpr std::string_view kSealBegin = "\nfloc-sha256 = ";
constexpr std::string_view kSealEnd = "\n";
static_assert(kSealBegin.size() + 64 + kSealEnd.size() == kSealSize);

constexpr std::string_view kHdf5Signature = "\x89HDF\r\n\x1a\n";

/// Whether the HDF5 library can open the file at this path. Other content must be copied to a file first: standard
/// input, pipes, and files that exist only in memory (entries of /proc without a file name). The library cannot open
/// files that exist only in memory, because it resolves symbolic links.
bool is_plain_file(const std::string& path) {
  std::error_code error;
  return path != "-" && std::filesystem::is_regular_file(path, error) &&
         !std::filesystem::canonical(path, error).empty();
}

std::unique_ptr<TemporaryFile> copy_of(const std::string& path) {
  auto copy = std::make_unique<TemporaryFile>();
  read_pieces(path, [&](std::string_view piece) {
    if (!write_all(copy->descriptor(), piece)) throw IoError(copy->path(), std::strerror(errno));
  });
  return copy;
}

/// Reads up to `n` bytes of a file from the position `offset` into `buffer`. Returns the bytes read: `n` bytes, or
/// fewer if the file ends earlier.
std::string_view read_at(int fd, const std::string& path, std::size_t offset, std::size_t n,
                         std::vector<char>& buffer) {
  buffer.resize(n);
  std::size_t got = 0;
  while (got < n) {
    const ssize_t more = ::pread(fd, buffer.data() + got, n - got, static_cast<off_t>(offset + got));
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) throw InputError(path, std::strerror(errno));
    if (more == 0) break;
    got += static_cast<std::size_t>(more);
  }
  return {buffer.data(), got};
}

std::string sha256_of_beginning(int fd, const std::string& path, std::size_t n_bytes) {
  constexpr std::size_t kPiece = 1 << 20;
  Sha256 hash;
  std::vector<char> buffer;
  for (std::size_t at = 0; at < n_bytes; at += kPiece)
    hash.update(read_at(fd, path, at, std::min(kPiece, n_bytes - at), buffer));
  return hash.digits();
}

std::size_t size_of(int fd) {
  return static_cast<std::size_t>(::lseek(fd, 0, SEEK_END));
}

}  // namespace

std::string seal_of(const std::string& sha256) {
  return std::string(kSealBegin).append(sha256).append(kSealEnd);
}

void append_seal(AtomicFile& file) {
  const int fd = file.descriptor();
  file.append(seal_of(sha256_of_beginning(fd, file.working_path(), size_of(fd))));
}

SealedFile::SealedFile(const std::string& path)
    : path_(path), copy_(is_plain_file(path) ? nullptr : copy_of(path)) {
  const Descriptor file(::open(content_path().c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.valid()) throw InputError(path, std::strerror(errno));
  const int fd = file.get();
  const std::size_t size = size_of(fd);
  std::vector<char> buffer;
  if (read_at(fd, path, 0, kHdf5Signature.size(), buffer) != kHdf5Signature)
    throw InputError(path, size == 0 ? "the file is empty, expected a floc state (HDF5)"
                                     : "the file is not a state file of floc (written by floc run or floc "
                                       "convert): it is not an HDF5 file");
  const std::size_t n = size < kSealSize ? 0 : size - kSealSize;
  const std::string tail(read_at(fd, path, n, kSealSize, buffer));
  if (n == 0 || !tail.starts_with(kSealBegin) || !tail.ends_with(kSealEnd))
    throw InputError(path,
                     "the file is truncated, or was not written by floc: the checksum at its end is missing");
  if (tail != seal_of(sha256_of_beginning(fd, path, n)))
    throw InputError(path, "the file is damaged: its content does not match the checksum at its end");
}

}  // namespace floc
