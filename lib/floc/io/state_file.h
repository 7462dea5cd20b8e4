#pragma once

#include <string>
#include <variant>

#include "floc/packing/state.h"

namespace floc {

using AnyState = std::variant<State<2>, State<3>>;

/// Version of the layout of state files that is written, and the newest that is read.
inline constexpr int kStateVersion = 2;

/// Writes a state to the HDF5 file `path`, in the layout of docs/states.md. The file is first written under a
/// temporary name in the same directory, synced, and then renamed, so it is either whole or absent. Identical states
/// give identical bytes.
/// @pre contacts name grains of the state
/// @param progress  text stored beside the state, from which a checkpoint continues inside a step; empty: none
/// @throws IoError if the directory cannot be written or the disk is full; `path` is then unchanged
template <int Dim>
void write_state(const std::string& path, const State<Dim>& state, const std::string& progress = "");

/// Reads a state file. Every number equals the one that was written.
/// @throws InputError naming file and dataset if the file is missing, truncated, foreign, of another version, or
/// holds data that no state can have (wrong shape, index out of range, a value that is not finite)
AnyState read_state(const std::string& path);

/// Reads the progress text of a checkpoint; empty for a plain state. @throws InputError as read_state()
std::string read_progress(const std::string& path);

}  // namespace floc
