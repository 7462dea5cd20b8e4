#pragma once

#include "floc/picture/packing_picture.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// What changed between two states, on the geometry of the first: contacts lost and gained, those kept thin,
/// and where each grain went with the affine part taken off.
/// @param changes  from `before` to `after`
template <int Dim>
PackingPicture<Dim> contacts_changed(const Packing<Dim>& before, const Packing<Dim>& after,
                                     const ContactChanges<Dim>& changes);

}  // namespace floc
