#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace floc {

/// Computes the hash SHA-256 (FIPS 180-4) of bytes that arrive piece by piece.
class Sha256 {
 public:
  void update(std::string_view bytes);
  /// Returns the SHA-256 of all bytes added so far, as 64 lower-case hexadecimal digits. No bytes can be added
  /// afterwards.
  std::string digits();

 private:
  std::array<std::uint32_t, 8> hash_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  /// Last bytes added, too few to fill a block of 64 bytes.
  std::array<unsigned char, 64> rest_{};
  std::uint64_t n_bytes_ = 0;
};

/// Returns the SHA-256 of a text, as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// Returns the SHA-256 of the content of a file, as 64 lower-case hexadecimal digits.
/// @throws InputError if the file cannot be read
std::string sha256_of_file(const std::string& path);

}  // namespace floc
