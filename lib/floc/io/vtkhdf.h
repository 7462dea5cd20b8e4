#pragma once

#include <string>

#include "floc/io/import.h"
#include "floc/io/state_file.h"

namespace floc {

/// Files in VTK's HDF format (VTKHDF), which ParaView opens. Files of the type UnstructuredGrid of version 1.0 are
/// written, which VTK reads from version 9.1 on. Files of the type PolyData can be read, too.
///
/// Grains are points with the arrays radius, mass and id; each of these points is a vertex. Contacts are lines with
/// arrays of cell data: normal_force, shear_force (on the first grain), stiffnesses, id2 (identifier of the second
/// grain), image and wall (-1, or the number of a wall). As in the draft of a format for discrete elements by the
/// network ON-DEM, normal_force is positive in tension: it is minus the normal force of floc. A line ends at the second
/// grain or, across a periodic boundary or at a wall, at a point of radius 0. Field data contain the cell, the
/// dimension, the walls and the boundary. The file contains no contact law.

bool is_vtkhdf(const std::string& path);

/// Reads a packing. In files of other programs, a line without the arrays above is a contact of the grains at its two
/// ends.
/// @throws InputError naming file and dataset
Imported read_vtkhdf(const std::string& path, const ImportOptions& options);

/// Writes a packing.
/// @throws InputError for grains with corners
void write_vtkhdf(const std::string& path, const AnyState& state);

}  // namespace floc
