#pragma once

#include <string>
#include <string_view>

namespace floc {

/// A state file is an HDF5 file followed by a seal: 80 bytes with the SHA-256 of all before them. HDF5 ignores
/// what follows its own end of file, so every reader of HDF5 opens it; floc looks at the seal first, because
/// the HDF5 library can crash on a file that is truncated or damaged.
std::string seal(std::string content);

/// The content that was sealed.
/// @throws InputError naming `path` if the seal is missing (truncated, not written by floc) or does not match.
std::string_view unseal(const std::string& path, std::string_view bytes);

}  // namespace floc
