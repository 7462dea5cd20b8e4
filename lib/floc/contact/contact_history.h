#pragma once

#include "floc/contact/declaration.h"

namespace floc {

/// Size of the history that a model keeps per contact, in `dim` dimensions (numbers).
template <class Model>
constexpr int history_size(int dim) {
  int n = 0;
  if constexpr (requires { Model::kHistory; })
    for (const History& m : Model::kHistory) n += n_components(m.kind, dim);
  return n;
}

/// Packed history of a contact under one law. Slots without history take no space.
template <int Size, class T = double>
struct PackedHistory {
  T value[Size];

  /// History of a new contact: all springs at rest.
  PackedHistory() {
    for (T& v : value) v = T(0);
  }
};
template <class T>
struct PackedHistory<0, T> {};

}  // namespace floc
