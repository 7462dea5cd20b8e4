#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Returns a lower bound of the number of mechanisms (motions without stiffness) of the grains of a packing
/// that carry force. The bound is the number of degrees of freedom of these grains minus the number of springs
/// of their contacts, with walls held fixed, or 0 if there are more springs. Grains without contact, with a
/// single contact, or at the end of a chain of such grains are left out. Rotations that no tangential, rolling
/// or twisting spring resists do not count as degrees of freedom, nor does the spin of a sphere about the line
/// of its two contacts. Between periodic boundaries, rigid translations are among the mechanisms.
template <int Dim>
int least_mechanisms(const Packing<Dim>& packing);

}  // namespace floc
