#pragma once

namespace floc {

/// Returns freed memory to the operating system, even if the memory lies between blocks that are in use. Call this
/// function after reading a text file of another program, because the text may have taken as much memory as the
/// packing. With a C library other than glibc, this function does nothing.
void return_freed_memory();

}  // namespace floc
