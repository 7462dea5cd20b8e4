#pragma once

#include <cstddef>

namespace floc {

/// Asks the operating system to use huge pages for a large block of memory before the block is first written. The
/// system then provides the block in pages of 2 MB instead of 4 kB. For a matrix of a gigabyte, providing pages of 4 kB
/// takes as much time as the arithmetic on the matrix. Blocks of less than four huge pages are left unchanged, and a
/// system without huge pages ignores the request.
void prefer_huge_pages(void* block, std::size_t bytes);

/// Allocates memory by malloc() and requests huge pages for it.
void* allocate_on_huge_pages(std::size_t bytes);

}  // namespace floc
