#pragma once

#include <vector>

#include "floc/picture/seen_packing.h"

namespace floc {

/// Without spheres of which nothing is to be seen, others being before every part of them. None that shows at
/// all is taken away; of those hidden some remain, since slivers narrower than about an eighth of the smallest
/// radius count as seen.
std::vector<SeenSphere> without_hidden(std::vector<SeenSphere> spheres);

}  // namespace floc
