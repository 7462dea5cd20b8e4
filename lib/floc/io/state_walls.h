#pragma once

#include "floc/io/hdf5_file.h"
#include "floc/io/state_archive.h"
#include "floc/packing/state.h"

/// The walls in a state file: group `walls` (docs/states.md).
namespace floc {

/// Writes the walls, the law of their contacts, and their load. Writes nothing for a packing without walls.
template <int Dim>
void write_walls(Hdf5Writer& file, WritingArchive& archive, const State<Dim>& state);

/// Reads the walls into the packing of a state whose cell has been read.
/// @throws InputError unless the walls come in pairs across an axis of a rectangular cell, one side of the cell apart
template <int Dim>
void read_walls(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& state);

}  // namespace floc
