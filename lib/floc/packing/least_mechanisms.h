#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// The fewest mechanisms that the force-carrying part of a packing can have, by counting alone: unknowns of its
/// grains less springs of its contacts, with walls held; 0 where there are more springs. Grains without
/// contact, and those that hang on a single contact or on a chain of such grains, are left out; rotations that
/// no spring across a contact resists, and the spin of a sphere about the line of its two contacts, do not
/// count as unknowns. Between periodic boundaries its rigid translations are among the mechanisms.
template <int Dim>
int least_mechanisms(const Packing<Dim>& packing);

}  // namespace floc
