#pragma once

#include <cstddef>

namespace floc {

/// Asks the system to back a large block with huge pages before it is first written: a block of a gigabyte is
/// then handed over in steps of 2 MB instead of 4 kB, which for a large matrix cost as much time as the
/// arithmetic on it. Small blocks are left alone; a system without huge pages ignores the request.
void prefer_huge_pages(void* block, std::size_t bytes);

/// Allocates memory by malloc() and requests huge pages for it.
void* allocate_on_huge_pages(std::size_t bytes);

}  // namespace floc
