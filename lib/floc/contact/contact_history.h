#pragma once

#include "floc/contact/declaration.h"

namespace floc {

/// How many numbers a contact remembers under a model, in `dim` dimensions.
template <class Model>
constexpr int history_size(int dim) {
  int n = 0;
  if constexpr (requires { Model::kHistory; })
    for (const History& m : Model::kHistory) n += n_components(m.kind, dim);
  return n;
}

/// The history of one law, packed: no byte for a slot that remembers nothing.
template <int Size, class T = double>
struct PackedHistory {
  T value[Size];

  /// A new contact: everything at rest.
  PackedHistory() {
    for (T& v : value) v = T(0);
  }
};
template <class T>
struct PackedHistory<0, T> {};

}  // namespace floc
