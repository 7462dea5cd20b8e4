#pragma once

#include <string>

#include "floc/io/import.h"
#include "floc/io/state_file.h"

namespace floc {

/// Files in VTK's HDF format (VTKHDF), which ParaView opens. floc writes files of the type UnstructuredGrid, version
/// 1.0, which VTK 9.1 and later can read. floc reads files of the types UnstructuredGrid and PolyData.
///
/// Grains are points with the arrays radius, mass and id; each of these points is a vertex. Contacts are lines with
/// arrays of cell data: normal_force, shear_force (on the first grain), stiffnesses, bridge_volume (of liquid bridges),
/// id2 (identifier of the second grain), image and wall (-1, or the number of a wall). In the file, normal_force is
/// positive in tension, that is, minus the normal force of floc. This is the convention in the draft of a format for
/// discrete elements by the network ON-DEM. The line of a contact ends at the second grain. The line of a contact
/// across a periodic boundary or with a wall ends at an additional point of radius 0. Field data contain the cell, the
/// dimension, the walls, the masses of walls that forces move, and the boundary. The file contains no contact law.

bool is_vtkhdf(const std::string& path);

/// Reads a packing. In files of other programs, lines may lack the arrays above. Each line then denotes a contact
/// between the grains at the two ends of the line.
/// @throws InputError naming file and dataset
Imported read_vtkhdf(const std::string& path, const ImportOptions& options);

/// Writes a packing.
/// @throws InputError for grains with corners
void write_vtkhdf(const std::string& path, const AnyState& state);

}  // namespace floc
