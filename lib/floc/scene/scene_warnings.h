#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// Returns warnings about a valid scene that may not give the intended result: tolerances that double precision or
/// Newton steps cannot reach, adhesion that reaches beyond the nearest neighbours, steps that are given up before they
/// can converge, grains that cannot stick together, a run that takes more than a month. Each warning gives the key, its
/// value, and the reason.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace floc
