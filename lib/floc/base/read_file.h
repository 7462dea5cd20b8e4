#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace floc {

/// Returns the whole content of a file, or of the standard input if the path is "-". A file compressed by gzip is
/// recognised by its content, not by its name, and decompressed.
/// @throws InputError with the error message of the operating system if the file is missing or cannot be read
std::string read_file(const std::string& path);

/// Returns up to `most` bytes from the beginning of a file, so that its format can be recognised without reading the
/// whole file. A file compressed by gzip is decompressed as far as needed.
/// @param path  name of the file. For "-" (the standard input), the result is empty, because the standard input can be
/// read only once
/// @param most  at most 65536
/// @throws InputError if the file is missing or cannot be read
std::string read_beginning(const std::string& path, std::size_t most);

/// Passes the content of a file to `take` piece by piece, so that the file need not fit into memory. A file compressed
/// by gzip is decompressed.
/// @param path  the file, or "-" for the standard input
/// @throws InputError if the file is missing or cannot be read
void read_pieces(const std::string& path, const std::function<void(std::string_view)>& take);

/// Returns whether a file begins with the signature of the format HDF5, as state files do.
/// @throws InputError under the conditions of read_beginning()
bool is_hdf5(const std::string& path);

}  // namespace floc
