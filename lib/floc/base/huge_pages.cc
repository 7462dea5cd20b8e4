#include "floc/base/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>

namespace floc {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
/// Size of the smallest block for which huge pages are requested (bytes). For smaller blocks, huge pages cost more time
/// than they save.
constexpr std::size_t kSmallest = 4 * kHugePage;

}  // namespace

void prefer_huge_pages(void* block, std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  if (block == nullptr || bytes < kSmallest) return;
  const auto start = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t first = (start + kHugePage - 1) / kHugePage * kHugePage;
  const std::uintptr_t end = (start + bytes) / kHugePage * kHugePage;
  if (end <= first) return;
  // The result is ignored, because the request is only advice: the program works even if the system ignores it.
  static_cast<void>(madvise(static_cast<char*>(block) + (first - start), end - first, MADV_HUGEPAGE));
#else
  static_cast<void>(block), static_cast<void>(bytes);
#endif
}

void* allocate_on_huge_pages(std::size_t bytes) {
  void* block = std::malloc(bytes);
  prefer_huge_pages(block, bytes);
  return block;
}

}  // namespace floc
