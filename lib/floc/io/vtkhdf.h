#pragma once

#include <string>

#include "floc/io/import.h"
#include "floc/io/state_file.h"

namespace floc {

/// Files in VTK's HDF format (VTKHDF), which ParaView opens. The type UnstructuredGrid of version 1.0 is written, which VTK reads from
/// version 9.1 on; PolyData is read, too.
///
/// Grains are points with the arrays radius, mass and id, and each of them is a vertex. Contacts are lines, with arrays of cell
/// data: normal_force (positive in tension, as the draft of a format for discrete elements by the network ON-DEM has it, so minus
/// the normal force of floc), shear_force (on the first grain), stiffnesses, id2 (identifier of the second grain), image and
/// wall (-1, or the number of a wall). A line ends at the second grain or, across a periodic boundary or at a wall, at a point of
/// radius 0. Field data hold the cell, the dimension, the walls and the boundary. The file holds no contact law.

bool is_vtkhdf(const std::string& path);

/// Reads a packing. In files of other programs, lines without the arrays above are contacts of the grains at their two ends.
/// @throws InputError naming file and dataset
Imported read_vtkhdf(const std::string& path, const ImportOptions& options);

/// @throws InputError for grains with corners
void write_vtkhdf(const std::string& path, const AnyState& state);

}  // namespace floc
