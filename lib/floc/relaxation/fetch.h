#pragma once

#include <cstddef>

#include "floc/base/aligned_vector.h"

namespace floc {

/// Asks for the cache line of a number that is read soon. It is brought to the second cache: the first is too small
/// to wait in. The processor foresees long runs through memory, but not the many short ones of a block of grains.
template <class T>
void fetch(const T* number) {
  constexpr int kToRead = 0, kSecondCache = 2;
  __builtin_prefetch(number, kToRead, kSecondCache);
  asm volatile("");  // to GCC a function that only prefetches has no effect, and it leaves out all calls of it
}

/// The same for array[first] to array[last - 1]. @param array  null: nothing
template <class T>
void fetch(const T* array, int first, int last) {
  if (array == nullptr) return;
  for (int k = first; k < last; k += static_cast<int>(kCacheLine / sizeof(T))) fetch(array + k);
}

/// The same for each of several arrays.
template <class T, std::size_t n>
void fetch_each(T* const (&arrays)[n], int first, int last) {
  for (const T* array : arrays) fetch(array, first, last);
}

}  // namespace floc
