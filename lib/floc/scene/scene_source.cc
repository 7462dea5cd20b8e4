#include "floc/scene/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/nearest_name.h"

namespace floc {
namespace {

toml::table parse_text(const std::string& text, const std::string& place) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}", place, error.source().begin.line), std::string(error.description()));
  }
}

std::vector<std::string> split_key(const std::string& key) {
  std::vector<std::string> parts;
  std::istringstream in(key);
  for (std::string part; std::getline(in, part, '.');) parts.push_back(part);
  return parts;
}

/// Returns the value of an override ("--set key=value") as the TOML table {v = value}. A word without quotation marks
/// is taken as a string.
/// @param text  the value, as the user wrote it
toml::table parse_value(const std::string& text) {
  try {
    return toml::parse("v = " + text);
  } catch (const toml::parse_error&) {
    return toml::table{{"v", text}};
  }
}

/// Follows one part of the key of an override (the text between two dots) from a TOML node to the next node. If `node`
/// is a table, the part is a key in it, and a missing key is added with an empty table as its value. If `node` is an
/// array, the part is the index of an item. Returns null if the array has no such item, or if `node` is neither a table
/// nor an array.
/// @param part  part of the key
toml::node* descend(toml::node* node, const std::string& part) {
  if (toml::table* table = node->as_table()) {
    if (!table->contains(part)) table->insert(part, toml::table{});
    return table->get(part);
  }
  if (toml::array* array = node->as_array()) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (error == std::errc{} && end == part.data() + part.size() && index < array->size())
      return array->get(index);
  }
  return nullptr;
}

bool is_below(const std::string& key, const std::string& parent) {
  return key.size() > parent.size() && key.compare(0, parent.size(), parent) == 0 && key[parent.size()] == '.';
}

}  // namespace

SceneSource::SceneSource(const std::string& text, std::string place, const std::vector<std::string>& overrides)
    : place_(std::move(place)), root_(parse_text(text, place_)) {
  for (const std::string& o : overrides) apply(o);
}

void SceneSource::apply(const std::string& override_text) {
  const auto equals = override_text.find('=');
  const std::string place = "--set " + override_text;
  const auto trimmed = [](std::string s) {
    s.erase(0, s.find_first_not_of(" \t"));
    s.erase(s.find_last_not_of(" \t") + 1);
    return s;
  };
  const std::string key = trimmed(override_text.substr(0, equals));
  const std::vector<std::string> parts = split_key(key);
  const bool has_empty_part = std::any_of(parts.begin(), parts.end(), [](const auto& p) { return p.empty(); });
  if (equals == std::string::npos || parts.empty() || has_empty_part)
    throw InputError(place, "an override must have the form key.path=value");

  toml::node* parent = &root_;
  for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
    toml::node* below = descend(parent, parts[k]);
    if (!below || !(below->is_table() || below->is_array()))
      throw InputError(
          place, fmt::format("the scene has no table or array item '{}' in which this override could set a key",
                             parts[k]));
    parent = below;
  }
  toml::table* table = parent->as_table();
  if (!table) throw InputError(place, "the last part of the path must be the name of a key in a table");
  const toml::table value = parse_value(trimmed(override_text.substr(equals + 1)));
  value.get("v")->visit([&](const auto& v) { table->insert_or_assign(parts.back(), v); });
  // If several overrides have the same key, the last one determines the value. This override is stored before the
  // others, because messages name the first stored override of a key.
  overrides_.insert(overrides_.begin(), {key, override_text});
}

const SceneSource::Override* SceneSource::override_of(const std::string& key) const {
  for (const Override& o : overrides_)
    if (o.key == key || is_below(key, o.key)) return &o;
  return nullptr;
}

unsigned SceneSource::line_of(const std::string& key, const toml::node* node) const {
  return node && !override_of(key) ? node->source().begin.line : 0;
}

std::string SceneSource::place_of(const std::string& key, const toml::node* node) const {
  if (const Override* o = override_of(key)) return "--set " + o->text;
  if (const unsigned line = line_of(key, node)) return fmt::format("{}:{}", place_, line);
  // A table without a line in the file was added by an override of one of its keys. The message names this override.
  for (const Override& o : overrides_)
    if (is_below(o.key, key)) return "--set " + o.text;
  return place_;
}

void SceneSource::fault(const std::string& key, const toml::node* node, const std::string& problem) {
  faults_.push_back({line_of(key, node), key, place_of(key, node) + ": " + problem});
}

void SceneSource::fault_at(const std::string& place, const std::string& problem) {
  faults_.push_back({0, "", place.empty() ? problem : place + ": " + problem});
}

bool SceneSource::is_faulty(const std::string& key) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& f) { return f.key == key; });
}

void SceneSource::throw_faults() const {
  if (faults_.empty()) return;
  std::vector<Fault> sorted = faults_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Fault& a, const Fault& b) { return a.line < b.line; });
  std::string all;
  for (const Fault& f : sorted) all += (all.empty() ? "" : "\n") + f.message;
  throw InputError("", all);
}

std::string as_written(const toml::node& node) {
  if (node.is_table()) return "a table";
  // fmt prints a number with the fewest digits that identify it, whereas toml++ prints 17 digits.
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  std::ostringstream out;
  node.visit([&](const auto& n) { out << n; });
  return out.str();
}

std::string nearest_key(std::string_view key, const std::vector<std::string>& candidates) {
  return nearest_name(key, candidates);
}

}  // namespace floc
