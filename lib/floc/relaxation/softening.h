#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Divides the stiffness of all springs of a packing by a factor `to`, relative to a contact law. Positions and the
/// elongations of all springs stay, and forces change with the stiffness.
/// @param law  contact law relative to which springs are softer
/// @param from  stiffness of the springs of `law` divided by that of the springs of `packing` before the change
template <int Dim>
void soften_in_place(Packing<Dim>& packing, const Law& law, double from, double to);

/// Divides the stiffness of all springs of a packing by a factor `to`, relative to a contact law, and keeps its forces:
/// the elongations of tangential, rolling and twisting springs follow their stiffness, and the grains and the cell are
/// displaced so that every overlap, too, belongs to its force. If there are too many contacts for an exact solution,
/// the sum of the squared errors of the normal forces, each divided by the stiffness of its contact, is minimal.
/// @param law  contact law relative to which springs are softer
/// @param from  stiffness of the springs of `law` divided by that of the springs of `packing` before the change
template <int Dim>
void change_softening(Packing<Dim>& packing, const Law& law, double from, double to);

}  // namespace floc
