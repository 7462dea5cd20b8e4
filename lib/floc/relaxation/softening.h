#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Sets the softening of all springs of a packing: the stiffness of each spring becomes its stiffness in `law`, divided
/// by `to`. Positions and the elongations of all springs do not change; forces change in proportion to the stiffness.
/// @param law  contact law relative to which springs are softer
/// @param from  stiffness of the springs of `law`, divided by the stiffness of the springs of `packing` before the
/// change
template <int Dim>
void soften_in_place(Packing<Dim>& packing, const Law& law, double from, double to);

/// Sets the softening of all springs of a packing and keeps their forces. The stiffness of each spring becomes its
/// stiffness in `law`, divided by `to`. The elongations of tangential, rolling and twisting springs change in inverse
/// proportion. The grains and the cell are displaced so that every overlap, too, agrees with the normal force of its
/// contact. If there are too many contacts for an exact solution, the normal forces have errors. The sum of the squared
/// errors, each divided by the stiffness of its contact, is then minimal.
/// @param law  contact law relative to which springs are softer
/// @param from  stiffness of the springs of `law`, divided by the stiffness of the springs of `packing` before the
/// change
template <int Dim>
void change_softening(Packing<Dim>& packing, const Law& law, double from, double to);

}  // namespace floc
