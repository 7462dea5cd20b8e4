#pragma once

#include "floc/io/hdf5_file.h"
#include "floc/io/state_archive.h"
#include "floc/packing/state.h"

/// Functions that write and read the groups `equilibrium` and `path` of a state file: the stress, the load and the
/// residuals of a state (docs/states.md).
namespace floc {

/// Writes the stress, the imposed stress, the residuals and their tolerances.
template <int Dim>
void write_equilibrium(WritingArchive& archive, const State<Dim>& state);

/// Reads the data that write_equilibrium() writes.
template <int Dim>
void read_equilibrium(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& state);

/// Writes the imposed load if the current stage of the load path imposes different loads on the axes. If the load is an
/// isotropic pressure, nothing is written.
template <int Dim>
void write_directed_load(Hdf5Writer& file, WritingArchive& archive, const State<Dim>& state);

/// Reads the data that write_directed_load() writes.
/// @throws InputError if the driven axis is not an axis of the packing, or cannot be sheared
template <int Dim>
void read_directed_load(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& state);

}  // namespace floc
