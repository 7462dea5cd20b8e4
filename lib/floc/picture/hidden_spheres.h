#pragma once

#include <vector>

#include "floc/picture/seen_packing.h"

namespace floc {

/// Removes the spheres that are completely hidden behind other spheres and returns the rest. No visible sphere is
/// removed. Some hidden spheres remain, because the test divides the picture into tiles, an eighth of the smallest
/// radius wide, and a tile counts as open unless a single sphere covers it.
std::vector<SeenSphere> without_hidden(std::vector<SeenSphere> spheres);

}  // namespace floc
