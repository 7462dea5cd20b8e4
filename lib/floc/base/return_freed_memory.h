#pragma once

namespace floc {

/// Returns freed memory to the system, even where it lies between blocks in use. After a file of another
/// program has been read as text, this may be as much memory as the packing itself takes. Does nothing where
/// the C library has no such call.
void return_freed_memory();

}  // namespace floc
