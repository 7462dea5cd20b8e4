#pragma once

#include <string>

namespace floc {

/// Returns the version of the program, "major.minor.patch".
std::string version();

/// Returns the git commit from which the program was built, or "unknown" if it was built outside of a git checkout.
std::string commit();

/// Returns the name and version of the compiler that built the program. Every state file contains them.
std::string compiler();

}  // namespace floc
