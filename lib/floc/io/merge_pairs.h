#pragma once

#include <string>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Merges contacts that a file lists twice, once from each of the two grains: of two rows of the same pair and image, the
/// second is left out. Contacts that are listed once are kept.
/// @return a sentence for the user: how many rows were left out, and of how many pairs the two rows contradict each other
/// because their forces are not opposite to each other to four digits
std::string merge_pairs(std::vector<ListedContact>& contacts);

}  // namespace floc
