#pragma once

#include <string>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Merges contacts that a file lists twice, once for each of the two grains: if two rows have the same pair and image,
/// the second row is left out. A contact that is listed once is kept.
/// @return a sentence for the user with two numbers: the rows that were left out, and the pairs whose two rows
/// contradict each other. Two rows agree if the forces on the two grains are equal and opposite, up to rounding to four
/// digits
std::string merge_pairs(std::vector<ListedContact>& contacts);

}  // namespace floc
