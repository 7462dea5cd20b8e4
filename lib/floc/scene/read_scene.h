#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// Reads a scene file, which describes a packing and its load path (in TOML; docs/scenes.md describes all keys).
///
/// Physical parameters have no default values. Numerical settings have the default values of the options structs.
/// @param path  name of the scene file; names of files in the scene are relative to its directory
/// @param overrides  texts "key.path=value", each of which replaces a value of the scene. They are applied in order
/// before the scene is checked. The value is TOML, but a word without quotation marks is taken as a string. An item of
/// an array is addressed by its index from 0: "load.0.to=1".
/// @param prices  file of the table of prices from which the table [accuracy] chooses numerical settings; if empty, the
/// table shipped with floc
/// @throws InputError if `prices` is not valid or does not apply to the scene. The InputError of a scene with faults
/// names each on a line of its own: "file:line: key = value: expectation", or "--set key=value: ..." for an override
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {},
                 const std::string& prices = "");

/// Reads a scene from a text, for example from the text that a state file contains.
/// @param text  text of the scene (TOML)
/// @param place  name of the text, for messages
/// @param directory  directory to which names of files in the text are relative
/// @param overrides  texts "key.path=value", each of which replaces a value, see read_scene()
/// @param prices  file of a table of prices, see read_scene()
/// @throws InputError that names every fault of the scene, see read_scene()
Scene parse_scene(const std::string& text, const std::string& place, const std::string& directory,
                  const std::vector<std::string>& overrides = {}, const std::string& prices = "");

/// Reads the scene that is stored in a state. A saved state from which the scene starts is looked for beside the scene.
/// The folder of the scene is not known; it is the folder of the state, or one of the two above, in which the scene can
/// be read: usually the folder of the run or that of a series of runs lies beside the scene.
/// @param text  text of the scene
/// @param file  name of the state file
/// @param why_not  set to the reason if the scene cannot be read
std::optional<Scene> scene_of_state(const std::string& text, const std::string& file, std::string& why_not);

}  // namespace floc
