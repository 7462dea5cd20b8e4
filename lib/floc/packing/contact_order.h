#pragma once

#include <algorithm>
#include <utility>

#include "floc/base/vec.h"

namespace floc {

/// Returns whether p comes before q in a sorted list. p and q are contacts or pairs of grains. Lists are sorted by (i,
/// j, image), then by the member `key` if the type has this member.
template <class Pair>
bool precedes(const Pair& p, const Pair& q) {
  if (p.i != q.i) return p.i < q.i;
  if (p.j != q.j) return p.j < q.j;
  for (int a = 0; a < p.image.size(); ++a)
    if (p.image[a] != q.image[a]) return p.image[a] < q.image[a];
  if constexpr (requires { p.key; }) return p.key < q.key;
  return false;
}

/// Returns whether two contacts join the same two bodies through the same periodic image; their keys may differ.
template <class Pair>
bool same_pair(const Pair& p, const Pair& q) {
  return p.i == q.i && p.j == q.j && p.image == q.image;
}

/// Returns a pair of grains with the two grains exchanged. Only i, j and image change; forces and other members do not
/// change.
template <class Pair>
Pair swapped(Pair pair) {
  std::swap(pair.i, pair.j);
  pair.image = -pair.image;
  return pair;
}

/// Returns whether a pair of grains has its canonical form: i < j or, for a grain and an image of itself, a positive
/// first non-zero component of the image. Lists store each pair once, in its canonical form.
template <class Pair>
bool is_canonical(const Pair& pair) {
  if (pair.i != pair.j) return pair.i < pair.j;
  const auto first = std::find_if(pair.image.begin(), pair.image.end(), [](int cells) { return cells != 0; });
  return first != pair.image.end() && *first > 0;
}

/// Returns a pair of grains in its canonical form (is_canonical()). If the grains have to be exchanged, only i, j and
/// image change.
template <class Pair>
Pair canonical(Pair pair) {
  return is_canonical(pair) ? pair : swapped(std::move(pair));
}

}  // namespace floc
