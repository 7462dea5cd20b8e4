#pragma once

#include "floc/contact/law.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table [contact]: one table for each slot of the law, with the keys that the models of the slot declare.
/// Invalid values are recorded as faults; the law then holds a valid number in their place.
Law read_law(TableReader& root, int dimension);

}  // namespace floc
