#pragma once

#include <string>

#include "floc/assembly/diameters.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the table grains.diameter. Invalid values are recorded as faults.
/// @param directory  directory that the file of a list is relative to
DiameterDistribution read_diameters(TableReader table, SceneSource& source, const std::string& directory);

}  // namespace floc
