#pragma once

#include <vector>

#include "floc/picture/seen_packing.h"

namespace floc {

/// Removes spheres that are completely hidden behind other spheres, and returns the others. Every visible sphere is
/// kept. Some hidden spheres are kept too: the picture is divided into square tiles, an eighth of the smallest radius
/// wide, and a tile counts as covered only if one sphere alone covers it.
std::vector<SeenSphere> without_hidden(std::vector<SeenSphere> spheres);

}  // namespace floc
