#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// Reads a scene file (TOML; keys in docs/scenes.md).
///
/// Physical parameters have no defaults; numerical settings have those of the options structs.
/// @param path       the file; files that it names are looked for beside it
/// @param overrides  "key.path=value" each, applied in order before the scene is read and checked like the rest
/// of it.
///                   The value is TOML; a bare word is taken as a string. An item of an array is its index from
///                   0: "load.0.to=1".
/// @throws InputError naming every fault of the scene, one line each, as "file:line: key = value: expectation"
/// (for an override "--set key=value: ...").
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from text, such as the scene stored in a state.
/// @param place      what messages call the text
/// @param directory  where files named by the text are looked for
Scene parse_scene(const std::string& text, const std::string& place, const std::string& directory,
                  const std::vector<std::string>& overrides = {});

}  // namespace floc
