#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// Returns warnings about a valid scene that may not give the intended result: equilibria stricter than doubles or
/// Newton steps can reach, attraction beyond the nearest neighbours, steps given up before they can end, grains that
/// cannot stick together, a path of more than a month. Each warning gives the key, its value, and the reason.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace floc
