#pragma once

#include "floc/io/hdf5_file.h"
#include "floc/io/state_archive.h"
#include "floc/packing/state.h"

/// Functions that write and read the walls of a packing, which are stored in the group `walls` of a state file
/// (docs/states.md).
namespace floc {

/// Writes the walls, the forces on them, and the contact law between grains and walls. Writes nothing for a packing
/// without walls.
template <int Dim>
void write_walls(Hdf5Writer& file, WritingArchive& archive, const State<Dim>& state);

/// Reads the walls, and the contact law between grains and walls, into the packing of a state.
/// @pre the cell of the packing has been read
/// @throws InputError unless the cell is rectangular along each axis with walls, and this axis has two walls whose
/// distance is the side of the cell
template <int Dim>
void read_walls(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& state);

}  // namespace floc
