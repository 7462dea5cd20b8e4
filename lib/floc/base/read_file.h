#pragma once

#include <string>

namespace floc {

/// The whole content of a file, or of stdin for "-".
/// @throws InputError with the system's words if it is missing or cannot be read.
std::string read_file(const std::string& path);

}  // namespace floc
