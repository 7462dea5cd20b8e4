#include "floc/scene/scene_changes.h"

#include <fmt/format.h>

#include <map>

#include "floc/scene/scene_source.h"

namespace floc {
namespace {

using Values = std::map<std::string, std::string>;

std::string below(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

/// Adds all values in a TOML node to `values`. Their keys are written with dots; tables in an array are numbered from
/// 0, as in "load.0.to".
/// @param path  key of the node itself; empty for the root table
void flatten(const toml::node& node, const std::string& path, Values& values) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) flatten(value, below(path, std::string(key.str())), values);
    return;
  }
  const toml::array* array = node.as_array();
  if (array != nullptr && array->is_homogeneous(toml::node_type::table)) {
    for (std::size_t k = 0; k < array->size(); ++k)
      flatten(*array->get(k), below(path, std::to_string(k)), values);
    return;
  }
  values[path] = as_written(node);
}

Values values_of(const std::string& text, const std::string& place) {
  SceneSource source(text, "the scene " + place, {});
  Values values;
  flatten(source.root(), "", values);
  return values;
}

std::string value_or_absent(const Values& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? "absent" : "= " + found->second;
}

}  // namespace

std::vector<std::string> scene_changes(const std::string& first, const std::string& here,
                                       const std::string& second, const std::string& there) {
  const Values a = values_of(first, here), b = values_of(second, there);
  Values keys = a;
  keys.insert(b.begin(), b.end());
  std::vector<std::string> changes;
  for (const auto& [key, value] : keys) {
    const std::string in_a = value_or_absent(a, key), in_b = value_or_absent(b, key);
    if (in_a != in_b) changes.push_back(fmt::format("{} {} {}, {} {}", key, in_a, here, in_b, there));
  }
  return changes;
}

}  // namespace floc
