#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Records a fault if the tolerances of a scene cannot resolve its loads: pressures below the allowed error of a
/// stress, or contacts so stiff that rounding alone leaves a larger error.
void check_resolution(TableReader& root, const Scene& scene);

}  // namespace floc
