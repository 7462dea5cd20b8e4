#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace floc {

/// Returns the whole content of a file, or of stdin for "-".
/// @throws InputError with the message of the system if it is missing or cannot be read
std::string read_file(const std::string& path);

/// Passes the content of a file to `take` piece by piece, for content that is not needed in memory as a whole.
/// @throws InputError as read_file()
void read_pieces(const std::string& path, const std::function<void(std::string_view)>& take);

}  // namespace floc
