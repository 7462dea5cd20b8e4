#pragma once

#include "floc/contact/law.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table [contact], which has one table for each component of the contact law (normal, adhesion, friction,
/// ...). Each component accepts the keys that its models declare. For an invalid value a fault is recorded, and the
/// returned law has a valid number in its place.
Law read_law(TableReader& root, int dimension);

}  // namespace floc
