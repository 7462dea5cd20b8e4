#pragma once

#include <string>
#include <string_view>

namespace floc {

/// SHA-256 of some bytes (FIPS 180-4), 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// SHA-256 of a file's content. @throws InputError if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace floc
