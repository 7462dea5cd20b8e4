#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc::test {

/// Returns grains at rest, of diameter and mass 1, at the given positions of a square or cubic cell. The caller
/// must find their contacts.
template <int Dim>
Packing<Dim> unit_grains(const std::vector<Vec<Dim>>& places, double side, const Law& law) {
  Packing<Dim> packing;
  packing.law = law;
  packing.cell.matrix *= side;
  packing.grains = Grains<Dim>::with_size(static_cast<int>(places.size()));
  packing.grains.position = places;
  packing.grains.radius.assign(places.size(), 0.5);
  packing.grains.mass.assign(places.size(), 1.0);
  return packing;
}

}  // namespace floc::test
