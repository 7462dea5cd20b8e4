#pragma once

#include <tuple>

#include "floc/packing/contact.h"

namespace floc {

/// The order of the contacts of a packing: by (i, j, image, key).
template <int Dim>
bool precedes(const Contact<Dim>& p, const Contact<Dim>& q) {
  if (std::tie(p.i, p.j) != std::tie(q.i, q.j)) return std::tie(p.i, p.j) < std::tie(q.i, q.j);
  for (int a = 0; a < Dim; ++a)
    if (p.image[a] != q.image[a]) return p.image[a] < q.image[a];
  return p.key < q.key;
}

}  // namespace floc
