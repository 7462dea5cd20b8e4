#pragma once

#include <string>
#include <variant>

#include "floc/packing/state.h"

namespace floc {

using AnyState = std::variant<State<2>, State<3>>;

/// Version of the layout of state files that is written, and the newest that is read.
inline constexpr int kStateVersion = 2;

/// Writes a state by the layout of docs/states.md, HDF5, to `path`: first under a temporary name in
/// the same directory, synced, then renamed, so the file is whole or absent. Identical states give identical
/// bytes.
/// @pre contacts name grains of the state.
/// @param progress  text stored beside the state, which a checkpoint needs to go on from inside a step; empty:
/// none
/// @throws IoError if the directory cannot be written or the disk is full; `path` is then as it was before.
template <int Dim>
void write_state(const std::string& path, const State<Dim>& state, const std::string& progress = "");

/// Reads a state file back: every number is the one that was written.
/// @throws InputError naming file and dataset if the file is missing, truncated, foreign, of another version,
/// or holds data that no state can have (wrong shape, index out of range, a value that is not finite).
AnyState read_state(const std::string& path);

/// The progress text of a checkpoint, empty for a plain state. @throws InputError as read_state().
std::string read_progress(const std::string& path);

}  // namespace floc
