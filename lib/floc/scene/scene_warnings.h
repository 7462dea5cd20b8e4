#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// Returns warnings about a scene that is valid but may not give the intended result, for example because rounding
/// errors exceed a tolerance, because adhesion acts beyond the nearest neighbours, because steps are given up before
/// they can converge, because grains cannot stick together, or because the run takes more than a month. Each warning
/// names the key and its value, and gives the reason.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace floc
