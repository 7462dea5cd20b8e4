#pragma once

#include "floc/scene/scene.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Records a fault if the tolerances of a scene are too coarse for its loads (a pressure is smaller than the accepted
/// error of a stress), if rounding errors of very stiff contacts exceed the tolerances, or if grains are so soft that
/// they overlap too far.
void check_resolution(TableReader& root, const Scene& scene);

}  // namespace floc
