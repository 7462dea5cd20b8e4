#pragma once

namespace floc {

/// Returns the number of bytes that this process can still allocate: the smallest of three numbers, namely the free
/// memory of the machine, the memory left below the limit of the process (ulimit -v), and the memory left below the
/// limit of the control group. Returns infinity if none of the three is known.
double free_memory();

}  // namespace floc
