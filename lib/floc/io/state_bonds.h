#pragma once

#include "floc/io/hdf5_file.h"
#include "floc/io/state_archive.h"
#include "floc/packing/state.h"

/// Functions that write and read the bond data of a state file: flags that mark the contacts that are bonds, and the
/// strengths of contacts (docs/states.md).
namespace floc {

/// Whether a state file contains the twisting moments and stiffnesses of the contacts. This is true if the law has
/// twisting resistance or if the packing has bonds of spheres, which may resist twisting, too.
template <int Dim>
bool keeps_twisting(const Packing<Dim>& packing);

/// If the packing has bonds, writes the flags that mark the contacts that are bonds. If any strength is given, writes
/// the strengths of the contacts.
template <int Dim>
void write_bonds(WritingArchive& archive, const State<Dim>& state);

/// Reads the flags that mark the contacts that are bonds, and the strengths of the contacts. @pre the contacts of the
/// packing have been read
template <int Dim>
void read_bonds(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& state);

}  // namespace floc
