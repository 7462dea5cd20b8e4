#pragma once

namespace floc {

/// Returns freed memory to the operating system, even if it lies between blocks that are in use. Call this function
/// after reading a file of another program as text, because the memory for the text may be as large as the packing.
/// With a C library other than glibc, this function does nothing.
void return_freed_memory();

}  // namespace floc
