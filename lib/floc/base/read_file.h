#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace floc {

/// Returns the whole content of a file, or of the standard input if the path is "-". A file compressed by gzip is
/// decompressed, whatever its name.
/// @throws InputError with the error message of the operating system if the file is missing or cannot be read
std::string read_file(const std::string& path);

/// Passes the content of a file to `take` piece by piece, so that the file need not fit into memory. A file compressed by
/// gzip is decompressed.
/// @param path  the file, or "-" for the standard input
/// @throws InputError if the file is missing or cannot be read
void read_pieces(const std::string& path, const std::function<void(std::string_view)>& take);

}  // namespace floc
