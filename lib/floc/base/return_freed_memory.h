#pragma once

namespace floc {

/// Gives freed memory back to the system, even where it lies between blocks in use. After a file of another
/// program has been read as text, this may be as much as the packing itself takes. Does nothing where the C
/// library has no such call.
void return_freed_memory();

}  // namespace floc
