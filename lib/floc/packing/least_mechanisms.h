#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// The fewest mechanisms that what carries force in a packing can have, by counting alone: unknowns of its
/// grains less springs of its contacts, walls held; 0 where there are more springs. Grains without contact, and
/// those that hang on a single one or on a chain of such, take no part; rotations that no spring across a
/// contact resists, and the spin of a sphere about the line of its two contacts, are no unknowns. Between
/// periodic boundaries its rigid translations are among the mechanisms.
template <int Dim>
int least_mechanisms(const Packing<Dim>& packing);

}  // namespace floc
