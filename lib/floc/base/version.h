#pragma once

#include <string>

namespace floc {

/// Version of the program, "major.minor.patch".
std::string version();

/// Git commit the program was built from, or "unknown" outside a checkout.
std::string commit();

/// Compiler and its version, as written into the provenance of every state.
std::string compiler();

}  // namespace floc
