#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// What a valid scene asks for that will not come out as it may have been meant: equilibria stricter than doubles
/// or Newton steps reach, attractions that reach past the neighbours, steps given up before they can end, grains
/// that cannot stick together, a path of more than a month. Each says the key, its value, and why.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace floc
