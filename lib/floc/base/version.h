#pragma once

#include <string>

namespace floc {

/// Returns the version of the program, "major.minor.patch".
std::string version();

/// Returns the git commit from which the program was built; "unknown" if its source was not a git checkout.
std::string commit();

/// Returns the name and version of the compiler that built the program. Every state file contains them.
std::string compiler();

}  // namespace floc
