#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "floc/base/error.h"

namespace floc {

/// Writes a structure as one line of JSON; numbers round-trip. `for_each_member(structure, visit)` calls
/// visit(name, member) for every member, so that writing and reading cannot differ.
template <class Structure, class ForEachMember>
std::string members_as_json(const Structure& structure, const ForEachMember& for_each_member) {
  nlohmann::json json;
  for_each_member(structure, [&json](const char* name, const auto& value) { json[name] = value; });
  return json.dump();
}

/// Reads a structure that members_as_json() wrote.
/// @param place, problem  place and words of the message if the text is not such a structure
/// @throws InputError(place) if a member is missing or of another kind
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
