#include "floc/io/sealed_bytes.h"

#include "floc/base/error.h"
#include "floc/base/sha256.h"

namespace floc {
namespace {

constexpr std::string_view kSealBegin = "\nfloc-sha256 = ";
constexpr std::string_view kSealEnd = "\n";
constexpr std::size_t kSealSize = 80;
static_assert(kSealBegin.size() + 64 + kSealEnd.size() == kSealSize);

constexpr std::string_view kHdf5Signature = "\x89HDF\r\n\x1a\n";

}  // namespace

std::string seal(std::string content) {
  const std::string hash = sha256(content);
  content.reserve(content.size() + kSealSize);
  content.append(kSealBegin).append(hash).append(kSealEnd);
  return content;
}

std::string_view unseal(const std::string& path, std::string_view bytes) {
  if (!bytes.starts_with(kHdf5Signature))
    throw InputError(path, bytes.empty() ? "is empty, expected a floc state (HDF5)"
                                         : "is not a floc state: not an HDF5 file");
  const std::size_t n = bytes.size() < kSealSize ? 0 : bytes.size() - kSealSize;
  const std::string_view tail = bytes.substr(n);
  if (n == 0 || !tail.starts_with(kSealBegin) || !tail.ends_with(kSealEnd))
    throw InputError(path, "is truncated, or was not written by floc: the checksum at its end is missing");
  const std::string_view content = bytes.substr(0, n);
  if (tail.substr(kSealBegin.size(), 64) != sha256(content))
    throw InputError(path, "is damaged: its content does not match the checksum at its end");
  return content;
}

}  // namespace floc
