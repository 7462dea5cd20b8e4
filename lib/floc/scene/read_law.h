#pragma once

#include "floc/contact/law.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the contact law of a scene from its table [contact], in which each component of the law (normal, adhesion,
/// friction, ...) has a table. The models of a component declare the keys of its table. For an invalid value a fault is
/// recorded, and the returned law has a valid number in its place.
Law read_law(TableReader& root, int dimension);

}  // namespace floc
