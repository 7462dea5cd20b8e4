#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Replaces the content of a file: written to `path` + ".part", synced, renamed over `path`, and the directory
/// synced. Whatever happens meanwhile, even a power cut, `path` holds all of the old content or all of the new.
/// A device or a pipe is written to, and - is standard output.
/// @throws InputError for an empty path
/// @throws IoError with the system's words if that fails; `path` is then as it was and the part is removed.
void write_bytes_atomically(const std::string& path, std::string_view bytes);

}  // namespace floc
