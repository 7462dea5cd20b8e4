#pragma once

#include "floc/contact/declaration.h"

namespace floc {

/// How many numbers a contact remembers under a model, in `dim` dimensions.
template <class Model>
constexpr int memory_size(int dim) {
  int n = 0;
  if constexpr (requires { Model::kMemory; })
    for (const Memory& m : Model::kMemory) n += n_components(m.kind, dim);
  return n;
}

/// The memory of one law, packed: no byte for a slot that remembers nothing.
template <int Size, class T = double>
struct PackedMemory {
  T value[Size];

  /// A new contact: everything at rest.
  PackedMemory() {
    for (T& v : value) v = T(0);
  }
};
template <class T>
struct PackedMemory<0, T> {};

}  // namespace floc
