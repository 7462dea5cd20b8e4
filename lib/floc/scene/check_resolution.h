#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Records faults of a scene whose tolerances cannot resolve what it asks for: pressures below the error that a
/// stress may have, or contacts so stiff that rounding alone leaves a larger one.
void check_resolution(TableReader& root, const Scene& scene);

}  // namespace floc
