#pragma once

#include <string>
#include <vector>

#include "floc/scene/scene.h"

namespace floc {

/// Reads a scene file (TOML; keys in docs/scenes.md).
///
/// Physical parameters have no defaults; numerical settings have the defaults of the options structs.
/// @param path       file; files that it names are relative to its directory
/// @param overrides  "key.path=value" each, applied in order before the scene is read, and checked like the rest of
/// it. The value is TOML; a bare word is a string. An item of an array is addressed by its index from 0:
/// "load.0.to=1".
/// @throws InputError naming every fault of the scene, one line each, as "file:line: key = value: expectation" (for
/// an override "--set key=value: ...")
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// Reads a scene from text, such as the scene stored in a state. @throws InputError as read_scene()
/// @param place      name of the text in messages
/// @param directory  directory that files named by the text are relative to
Scene parse_scene(const std::string& text, const std::string& place, const std::string& directory,
                  const std::vector<std::string>& overrides = {});

}  // namespace floc
