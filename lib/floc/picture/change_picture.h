#pragma once

#include "floc/picture/packing_picture.h"
#include "floc/structure/contact_changes.h"

namespace floc {

/// What changed between two states, on the geometry of the first: contacts lost and gained, those kept thin,
/// and where each grain went with the affine part taken off.
/// @param changes  from `before` to `after`
PackingPicture contacts_changed(const Packing<2>& before, const Packing<2>& after,
                                const ContactChanges<2>& changes);

}  // namespace floc
