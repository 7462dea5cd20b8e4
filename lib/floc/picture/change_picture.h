#pragma once

#include "floc/picture/packing_picture.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// Returns a picture of the changes between two states of a packing. The grains have their positions of the first
/// state. The picture shows lost contacts, gained contacts and, as thin lines, contacts that exist in both states.
/// Arrows show the displacements of the grains minus the displacements that a uniform deformation of the cell gives
/// them.
/// @param changes  changes from the state `before` to the state `after`
template <int Dim>
PackingPicture<Dim> contacts_changed(const Packing<Dim>& before, const Packing<Dim>& after,
                                     const ContactChanges<Dim>& changes);

}  // namespace floc
