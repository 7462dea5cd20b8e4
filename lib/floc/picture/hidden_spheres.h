#pragma once

#include <vector>

#include "floc/picture/seen_packing.h"

namespace floc {

/// The spheres without those that others hide completely. None that shows at all is taken away; some
/// hidden ones remain, since slivers narrower than about an eighth of the smallest radius count as
/// seen.
std::vector<SeenSphere> without_hidden(std::vector<SeenSphere> spheres);

}  // namespace floc
