#pragma once

#include <string>

#include "floc/io/state_file.h"

namespace floc {

/// What read_state() reads, of a file whose seal another process has checked (SealedFile): the caller answers for
/// that.
AnyState read_checked_state(const std::string& path);

}  // namespace floc
