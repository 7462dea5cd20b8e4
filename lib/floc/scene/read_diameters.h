#pragma once

#include <string>

#include "floc/assembly/diameters.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table grains.diameter. What cannot be used is recorded as a fault.
/// @param directory  where the file of a list is looked for
DiameterDistribution read_diameters(TableReader table, SceneSource& source, const std::string& directory);

}  // namespace floc
