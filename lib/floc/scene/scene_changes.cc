#include "floc/scene/scene_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "floc/base/parse_number.h"
#include "floc/scene/scene_source.h"

namespace floc {
namespace {

using Values = std::map<std::string, std::string>;

std::string below(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

/// Adds all values in a TOML node to `values`, each with its key. In a key, the names of nested tables are joined by
/// dots, and the tables of an array are numbered from 0, as in "load.0.to".
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

/// Returns the number of the load stage that a key belongs to, for example 3 for "load.3.to"; -1 for other keys.
int stage_of(const std::string& key) {
  constexpr std::string_view kLoad = "load.";
  if (!key.starts_with(kLoad)) return -1;
  return parse_number<int>(key.substr(kLoad.size(), key.find('.', kLoad.size()) - kLoad.size())).value_or(-1);
}

bool is_end_of_stage(const std::string& key) {
  const std::string name = key.substr(key.rfind('.') + 1);
  return name == "to" || name == "strain" || name == "stress" || name == "steps";
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

bool continues_path(const std::string& longer, const std::string& begun) {
  const Values now = values_of(longer, ""), before = values_of(begun, "");
  int last = -1;
  for (const auto& [key, value] : before) last = std::max(last, stage_of(key));
  bool differ = false;
  Values keys = now;
  keys.insert(before.begin(), before.end());
  for (const auto& [key, value] : keys) {
    if (value_or_absent(now, key) == value_or_absent(before, key)) continue;
    differ = true;
    const int stage = stage_of(key);
    const bool is_longer =
        stage == last && stage >= 0 && is_end_of_stage(key) && now.contains(key) && before.contains(key);
    if (stage <= last && !is_longer) return false;
  }
  return differ;
}

}  // namespace floc
