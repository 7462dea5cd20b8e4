#pragma once

#include <string>

#include "floc/io/state_file.h"

namespace floc {

/// Reads a state as read_state() does, but without a check of its seal. The caller guarantees that another process
/// has checked the seal (SealedFile).
/// @throws InputError as read_state(), except for a missing or wrong seal
AnyState read_checked_state(const std::string& path);

}  // namespace floc
