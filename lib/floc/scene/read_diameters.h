#pragma once

#include <string>

#include "floc/assembly/diameters.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table grains.diameter of a scene: the distribution of the diameters of grains. Faults are recorded for
/// invalid values.
/// @param directory  directory to which the names of files with diameters or sieves are relative
/// @param dimension  2 or 3, dimension of the scene
/// @param units  units of the scene, "reduced" or "SI"
DiameterDistribution read_diameters(TableReader table, SceneSource& source, const std::string& directory,
                                    int dimension, const std::string& units);

}  // namespace floc
