#pragma once

namespace floc {

/// Returns the number of bytes that this process can still allocate: the smallest of the memory that is free on the
/// machine, the memory left below the limit of the process (ulimit -v), and the memory left below the limit of its
/// control group. Returns infinity if none of these is known.
double free_memory();

}  // namespace floc
