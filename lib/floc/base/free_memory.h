#pragma once

namespace floc {

/// Returns the number of bytes that this process can still allocate: the least of the memory free on the
/// machine and of the remainders of the limits of the process (ulimit -v) and of its control group. Infinite
/// where none is known.
double free_memory();

}  // namespace floc
