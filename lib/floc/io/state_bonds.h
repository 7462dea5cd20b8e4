#pragma once

#include "floc/io/hdf5_file.h"
#include "floc/io/state_archive.h"
#include "floc/packing/state.h"

/// Writes and reads which contacts of a packing are bonds, and the strengths of contacts (docs/states.md).
namespace floc {

template <int Dim>
bool has_bonds(const Packing<Dim>& packing);

/// Whether a state file contains the twisting moments and stiffnesses of the contacts. It does if the law has twisting
/// resistance, and for bonds of spheres, which may have it.
template <int Dim>
bool keeps_twisting(const Packing<Dim>& packing);

/// Writes the flags of the contacts that are bonds and the strengths of contacts, as far as there are any.
template <int Dim>
void write_bonds(WritingArchive& archive, const State<Dim>& state);

/// Reads the flags of the contacts that are bonds, and the strengths of contacts. @pre the contacts of the packing have been
/// read
template <int Dim>
void read_bonds(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& state);

}  // namespace floc
