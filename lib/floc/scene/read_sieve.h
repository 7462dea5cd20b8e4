#pragma once

#include <string>

#include "floc/assembly/diameters.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the keys of a table grains.diameter with distribution = "sieve". In a file or in the arrays `sizes` and
/// `passing`, they give several sieves and the percentage of the mass of all grains that passes each sieve. Sets the
/// curve, min and max of the distribution. Faults are recorded for invalid values.
/// @param directory  directory to which the name of the file is relative
/// @param units  units of the scene, "reduced" or "SI"
void read_sieve(TableReader& table, SceneSource& source, const std::string& directory, const std::string& units,
                DiameterDistribution& distribution);

}  // namespace floc
