#pragma once

#include <string>

#include "floc/assembly/diameters.h"
#include "floc/scene/table_reader.h"

namespace floc {

/// Reads the keys of a table grains.diameter with distribution = "sieve". The keys give the sizes of several sieves
/// and, for each sieve, the percentage by mass of the grains that pass it. These numbers are in a file or in the arrays
/// `sizes` and `passing`. Sets the curve, min and max of the distribution. Faults are recorded for invalid values.
/// @param directory  directory to which the name of the file is relative
/// @param units  units of the scene, "reduced" or "SI"
void read_sieve(TableReader& table, SceneSource& source, const std::string& directory, const std::string& units,
                DiameterDistribution& distribution);

}  // namespace floc
