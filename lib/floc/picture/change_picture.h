#pragma once

#include "floc/picture/packing_picture.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// Returns a picture of the changes between two states, drawn at the grain positions of the first state. It shows lost
/// and gained contacts, kept contacts as thin lines, and the displacement of each grain, without the affine part that
/// the deformation of the cell explains.
/// @param changes  changes from `before` to `after`
template <int Dim>
PackingPicture<Dim> contacts_changed(const Packing<Dim>& before, const Packing<Dim>& after,
                                     const ContactChanges<Dim>& changes);

}  // namespace floc
