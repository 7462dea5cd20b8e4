#pragma once

#include "floc/contact/law.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table [contact]: one table for each slot of the law, its keys those that the slot's models
/// declare. What cannot be used is recorded as a fault; the law then holds some valid number in its place.
Law read_law(TableReader& root, int dimension);

}  // namespace floc
