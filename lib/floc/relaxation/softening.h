#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Gives a packing the contact law whose springs are softer by a factor `to`. Positions and the elongations of all
/// springs stay, and forces change with the stiffness.
/// @param packing  packing whose springs are softer than those of `law` by a factor `from`
template <int Dim>
void soften_in_place(Packing<Dim>& packing, const Law& law, double from, double to);

/// Gives a packing the contact law whose springs are softer by a factor `to`, and keeps its forces: the elongations of
/// tangential, rolling and twisting springs follow their stiffness, and the grains and the cell are displaced so that
/// every overlap, too, is the one of its force. Where contacts are so many that no displacement does this exactly, the
/// squared errors of the normal forces, each over the stiffness of its contact, are least.
/// @param packing  packing whose springs are softer than those of `law` by a factor `from`
template <int Dim>
void change_softening(Packing<Dim>& packing, const Law& law, double from, double to);

}  // namespace floc
