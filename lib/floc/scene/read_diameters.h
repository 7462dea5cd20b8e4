#pragma once

#include <string>

#include "floc/assembly/diameters.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table grains.diameter of a scene: the distribution of the diameters of grains. Faults are recorded for
/// invalid values.
/// @param directory  directory to which the name of a file with diameters is relative
DiameterDistribution read_diameters(TableReader table, SceneSource& source, const std::string& directory);

}  // namespace floc
