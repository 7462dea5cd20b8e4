#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Returns a lower bound on the number of mechanisms (motions without stiffness) of a packing with fixed walls. The
/// bound is the number of degrees of freedom of the grains minus the number of springs in their contacts, or 0 if this
/// difference is negative. Three kinds of motion do not count: motions of grains without contact, with a single
/// contact, or in a chain that ends with such a grain; rotations that no tangential, rolling or twisting spring and, of
/// a grain with corners, no normal force resists; the spin of a sphere about the line through its only two contacts.
/// With periodic boundaries, rigid translations are among the mechanisms.
template <int Dim>
int least_mechanisms(const Packing<Dim>& packing);

}  // namespace floc
