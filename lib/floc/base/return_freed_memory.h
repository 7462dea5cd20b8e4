#pragma once

namespace floc {

/// Returns freed memory to the operating system, even if it lies between blocks that are in use. After a file of
/// another program has been read as text, the freed memory may be as large as the packing itself. This function has no
/// effect if the C library cannot do this.
void return_freed_memory();

}  // namespace floc
