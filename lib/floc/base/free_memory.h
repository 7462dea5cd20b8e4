#pragma once

namespace floc {

/// Bytes that this process can still get: what the machine has free, and what limits of the process (ulimit -v)
/// and of its control group leave. Infinite where nothing says.
double free_memory();

}  // namespace floc
