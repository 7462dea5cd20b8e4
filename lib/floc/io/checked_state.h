#pragma once

#include <string>

#include "floc/io/state_file.h"

namespace floc {

/// Reads what read_state() reads, from a file whose seal another process has checked (SealedFile): the caller
/// answers for that.
AnyState read_checked_state(const std::string& path);

}  // namespace floc
