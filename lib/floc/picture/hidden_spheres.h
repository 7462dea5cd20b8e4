#pragma once

#include <vector>

#include "floc/picture/seen_packing.h"

namespace floc {

/// Returns the spheres without those that others hide completely. No visible sphere is removed. Some hidden
/// ones remain, since slivers narrower than about an eighth of the smallest radius count as visible.
std::vector<SeenSphere> without_hidden(std::vector<SeenSphere> spheres);

}  // namespace floc
