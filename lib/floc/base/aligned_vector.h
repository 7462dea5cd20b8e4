#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace floc {

/// Alignment of the elements of AlignedVector (bytes): the size of a cache line, and of the widest vector register.
inline constexpr std::size_t kCacheLine = 64;

template <class T>
struct CacheLineAllocator {
  using value_type = T;

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}  // NOLINT(google-explicit-constructor)

  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{kCacheLine}));
  }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{kCacheLine}); }

  template <class U>
  bool operator==(const CacheLineAllocator<U>&) const {
    return true;
  }
};

/// A vector whose first element lies at the beginning of a cache line. A vector register loaded from this vector
/// therefore never spans two cache lines. An array in a std::vector can begin anywhere within a cache line, which made
/// the speed of loops vary by a tenth.
template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace floc
