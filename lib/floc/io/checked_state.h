#pragma once

#include <string>

#include "floc/io/state_file.h"

namespace floc {

/// Reads a state file without verifying its seal (the checksum at the end of the file, see SealedFile). The caller
/// guarantees that another process has verified the seal.
/// @throws InputError under the conditions of read_state(), except for a missing or wrong seal
AnyState read_checked_state(const std::string& path);

}  // namespace floc
