#pragma once

#include "floc/contact/declaration.h"

namespace floc {

/// Returns the number of values that a model of a contact law stores per contact, in `dim` dimensions.
template <class Model>
constexpr int history_size(int dim) {
  int n = 0;
  if constexpr (requires { Model::kHistory; })
    for (const History& m : Model::kHistory) n += n_components(m.kind, dim);
  return n;
}

/// History of a contact: the numbers that the models of the contact law store for this contact, such as the elongations
/// of its springs. They are packed without gaps.
template <int Size, class T = double>
struct PackedHistory {
  T value[Size];

  /// Creates the history of a new contact, in which all springs have zero elongation.
  PackedHistory() {
    for (T& v : value) v = T(0);
  }
};
template <class T>
struct PackedHistory<0, T> {};

}  // namespace floc
