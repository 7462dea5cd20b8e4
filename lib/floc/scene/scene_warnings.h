#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// What a valid scene asks for that may not come out as it was meant: equilibria stricter than doubles or
/// Newton steps can reach, attractions beyond the nearest neighbours, steps given up before they can end,
/// grains that cannot stick together, a path of more than a month. Each gives the key, its value, and why.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace floc
