#pragma once

namespace floc {

/// Returns freed memory to the operating system, even if it lies between blocks that are in use. It is called after a
/// file of another program has been read as text, because the memory for this text may be as large as the packing. With
/// a C library other than glibc, this function does nothing.
void return_freed_memory();

}  // namespace floc
