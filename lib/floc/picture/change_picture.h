#pragma once

#include "floc/picture/packing_picture.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// Returns a picture of the changes between two states, on the geometry of the first: contacts lost and gained,
/// kept contacts as thin lines, and the displacement of each grain without the affine part.
/// @param changes  from `before` to `after`
template <int Dim>
PackingPicture<Dim> contacts_changed(const Packing<Dim>& before, const Packing<Dim>& after,
                                     const ContactChanges<Dim>& changes);

}  // namespace floc
