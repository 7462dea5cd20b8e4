#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Lower bound of the number of mechanisms of the force-carrying part of a packing, by counting: unknowns of
/// its grains less springs of its contacts, with walls held; 0 where there are more springs. Grains without
/// contact, with a single contact, or at the end of a chain of such grains are left out. Rotations that no
/// tangential, rolling or twisting spring resists, and the spin of a sphere about the line of its two contacts,
/// do not count as unknowns. Between periodic boundaries, rigid translations are among the mechanisms.
template <int Dim>
int least_mechanisms(const Packing<Dim>& packing);

}  // namespace floc
