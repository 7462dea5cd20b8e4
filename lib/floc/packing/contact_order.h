#pragma once

#include <algorithm>
#include <utility>

#include "floc/base/vec.h"

namespace floc {

/// The order of pairs of grains and of the contacts of a packing: by (i, j, image), and the key where they have
/// one.
template <class Pair>
bool precedes(const Pair& p, const Pair& q) {
  if (p.i != q.i) return p.i < q.i;
  if (p.j != q.j) return p.j < q.j;
  for (int a = 0; a < p.image.size(); ++a)
    if (p.image[a] != q.image[a]) return p.image[a] < q.image[a];
  if constexpr (requires { p.key; }) return p.key < q.key;
  return false;
}

/// The same pair with its grains exchanged: only i, j and image change, not what acts between them.
template <class Pair>
Pair swapped(Pair pair) {
  std::swap(pair.i, pair.j);
  pair.image = -pair.image;
  return pair;
}

/// Whether a pair is in the one of its two forms that lists hold: i < j or, for a grain and its own image, the
/// first non-zero component of the image positive.
template <class Pair>
bool is_canonical(const Pair& pair) {
  if (pair.i != pair.j) return pair.i < pair.j;
  const auto first = std::find_if(pair.image.begin(), pair.image.end(), [](int cells) { return cells != 0; });
  return first != pair.image.end() && *first > 0;
}

/// The form that lists hold, of a pair in either form: i, j and image alone where it is swapped.
template <class Pair>
Pair canonical(Pair pair) {
  return is_canonical(pair) ? pair : swapped(std::move(pair));
}

}  // namespace floc
