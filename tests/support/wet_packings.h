#pragma once

#include <cmath>

#include "floc/packing/liquid/liquid.h"

namespace floc::test {

/// Returns the total volume of all bridges of a packing. The volume of broken bridges is included.
template <int Dim>
double all_volumes(const Packing<Dim>& packing) {
  double sum = 0.0;
  for (const Contact<Dim>& c : packing.contacts) sum += std::abs(bridge_volume(packing, c));
  return sum;
}

/// Returns the total volume of liquid in a packing.
template <int Dim>
double liquid_of(const Packing<Dim>& packing) {
  return BridgeSearch(*packing.law.liquid(), packing.grains.radius).liquid();
}

}  // namespace floc::test
