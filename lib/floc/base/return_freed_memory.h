#pragma once

namespace floc {

/// Gives memory that was freed back to the system, also where it lies between blocks in use: of a file of another
/// program, read as text, it may be as much as the packing itself takes. Does nothing where the C library has no
/// such call.
void return_freed_memory();

}  // namespace floc
