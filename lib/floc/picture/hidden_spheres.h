#pragma once

#include <vector>

#include "floc/picture/seen_packing.h"

namespace floc {

/// Removes the spheres that are completely hidden behind other spheres and returns the rest. No visible sphere is
/// removed. Some hidden spheres remain, because gaps narrower than about an eighth of the smallest radius count as
/// openings.
std::vector<SeenSphere> without_hidden(std::vector<SeenSphere> spheres);

}  // namespace floc
