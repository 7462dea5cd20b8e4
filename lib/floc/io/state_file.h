#pragma once

#include <string>
#include <variant>

#include "floc/packing/state.h"

namespace floc {

using AnyState = std::variant<State<2>, State<3>>;

/// Version of the layout of the state files that this version of floc writes. State files with a newer layout cannot be
/// read.
inline constexpr int kStateVersion = 2;

/// Writes a state to the HDF5 file `path`, in the layout of docs/states.md. The state is first written to a file with a
/// temporary name in the same directory, which is synced and then renamed to `path`, so that `path` is never an
/// incomplete file. Identical states give identical bytes.
/// @pre the bodies of all contacts are grains or walls of the state
/// @param progress  for a checkpoint (a state saved within a step of the load path), the text from which the run
/// continues the step; empty for other states
/// @throws IoError if the directory cannot be written or the disk is full; the file `path` is then unchanged
template <int Dim>
void write_state(const std::string& path, const State<Dim>& state, const std::string& progress = "");

/// Reads a state file. The numbers are exactly those that were written.
/// @throws InputError naming file and dataset if the file is missing, truncated, not a state file, or written by a
/// newer version of floc, or if it contains invalid data (wrong shape, index out of range, a value that is not finite)
AnyState read_state(const std::string& path);

/// Reads the text `progress` that write_state() stored with the state of a checkpoint. Returns an empty text for other
/// states.
/// @throws InputError under the conditions of read_state()
std::string read_progress(const std::string& path);

}  // namespace floc
