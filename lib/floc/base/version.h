#pragma once

#include <string>

namespace floc {

/// Returns the version of the program, "major.minor.patch".
std::string version();

/// Returns the git commit that the program was built from, or "unknown" outside a checkout.
std::string commit();

/// Returns the compiler and its version, as written into the provenance of every state.
std::string compiler();

}  // namespace floc
