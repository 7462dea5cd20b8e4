#pragma once

namespace floc {

/// Returns the number of bytes that this process can still allocate. This is the smallest of three numbers: the free
/// memory of the machine, the memory left below the limit of the process (ulimit -v), and the memory left below the
/// limit of its control group. Returns infinity if none of the three numbers is known.
double free_memory();

}  // namespace floc
