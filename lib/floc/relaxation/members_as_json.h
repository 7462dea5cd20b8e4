#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "floc/base/error.h"

namespace floc {

/// Writes a structure as one line of JSON. Numbers that are read back from this text are unchanged.
/// @param for_each_member  function that calls visit(name, member) for every member; it is used for both writing and
/// reading, so the two formats cannot differ
template <class Structure, class ForEachMember>
std::string members_as_json(const Structure& structure, const ForEachMember& for_each_member) {
  nlohmann::json json;
  for_each_member(structure, [&json](const char* name, const auto& value) { json[name] = value; });
  return json.dump();
}

/// Reads a structure that members_as_json() wrote.
/// @param place  place of the text, named in the error message
/// @param problem  beginning of the error message about a text that does not contain the structure
/// @throws InputError(place) if a member is missing or has another type
template <class Structure, class ForEachMember>
Structure members_from_json(const std::string& text, const std::string& place, const std::string& problem,
                            const ForEachMember& for_each_member) {
  Structure structure;
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    for_each_member(structure, [&json](const char* name, auto& value) { json.at(name).get_to(value); });
  } catch (const nlohmann::json::exception& error) {
    throw InputError(place, problem + ": " + error.what());
  }
  return structure;
}

}  // namespace floc
