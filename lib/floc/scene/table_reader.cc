#include "floc/scene/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/parse_number.h"

namespace floc {
namespace {

/// Returns the value of a TOML node as a number; std::nullopt if it is not a whole or real number, or not finite.
std::optional<double> finite_number(const toml::node& node) {
  std::optional<double> value;
  if (node.is_integer()) value = static_cast<double>(node.as_integer()->get());
  if (node.is_floating_point()) value = node.as_floating_point()->get();
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

const toml::node* TableReader::find(const std::string& key, const char* expectation, Need need) {
  known_.push_back(key);
  if (!table_) return nullptr;
  const toml::node* node = table_->get(key);
  if (!node && need == Need::required)
    source_->fault(path_, table_, fmt::format("{} is missing: expected {}", path_of(key), expectation));
  return node;
}

void TableReader::refuse_value(const std::string& key, const toml::node& node, const std::string& expectation) {
  source_->fault(path_of(key), &node,
                 fmt::format("{} = {}: expected {}", path_of(key), as_written(node), expectation));
}

void TableReader::fault(const std::string& key, const std::string& problem) {
  if (!table_) return;
  const toml::node* node = table_->get(key);
  source_->fault(node ? path_of(key) : path_, node ? node : table_, problem);
}

void TableReader::refuse(const std::string& key, const std::string& problem) {
  known_.push_back(key);
  if (has(key)) fault(key, problem);
}

std::optional<double> TableReader::number(const std::string& key, NumberRule rule, Need need) {
  const toml::node* node = find(key, rule.expectation, need);
  if (!node) return std::nullopt;
  const auto value = finite_number(*node);
  if (value && rule.holds(*value)) return value;
  refuse_value(key, *node, rule.expectation);
  return std::nullopt;
}

std::optional<std::int64_t> TableReader::integer(const std::string& key, IntegerRule rule, Need need) {
  const toml::node* node = find(key, rule.expectation, need);
  if (!node) return std::nullopt;
  const std::int64_t value = node->is_integer() ? node->as_integer()->get() : 0;
  if (node->is_integer() && value >= rule.at_least && value <= rule.at_most) return value;
  const auto* number = node->as_floating_point();
  // In TOML, 2 is a whole number and 2.0 is a real number. A real number is not accepted here, even if it has a whole
  // value, such as 2.0.
  if (number != nullptr && whole_number(number->get()))
    fault(key, fmt::format("{} = {:.1f}: expected {}, written without a decimal point", path_of(key),
                           number->get(), rule.expectation));
  else
    refuse_value(key, *node, rule.expectation);
  return std::nullopt;
}

std::optional<std::string> TableReader::text(const std::string& key, const char* expectation, Need need) {
  const toml::node* node = find(key, expectation, need);
  if (!node) return std::nullopt;
  if (node->is_string()) return node->as_string()->get();
  refuse_value(key, *node, expectation);
  return std::nullopt;
}

std::optional<std::size_t> TableReader::choice(const std::string& key, const std::vector<std::string>& choices,
                                               Need need) {
  std::string expectation;
  for (std::size_t i = 0; i < choices.size(); ++i)
    expectation += (i == 0 ? "\"" : i + 1 == choices.size() ? " or \"" : ", \"") + choices[i] + "\"";
  const toml::node* node = find(key, expectation.c_str(), need);
  if (!node) return std::nullopt;
  if (node->is_string()) {
    const auto found = std::find(choices.begin(), choices.end(), node->as_string()->get());
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  }
  refuse_value(key, *node, expectation);
  return std::nullopt;
}

TableReader TableReader::table(const std::string& key, const char* expectation, Need need) {
  const toml::node* node = find(key, expectation, need);
  const toml::table* table = node ? node->as_table() : nullptr;
  if (node && !table) refuse_value(key, *node, expectation);
  return {*source_, table, path_of(key)};
}

std::vector<TableReader> TableReader::tables(const std::string& key, const char* expectation) {
  const toml::node* node = find(key, expectation, Need::optional);
  std::vector<TableReader> readers;
  if (!node) return readers;
  const toml::array* array = node->as_array();
  if (!array || !array->is_homogeneous(toml::node_type::table)) {
    refuse_value(key, *node, expectation);
    return readers;
  }
  for (std::size_t i = 0; i < array->size(); ++i)
    readers.emplace_back(*source_, array->get(i)->as_table(), fmt::format("{}.{}", path_of(key), i));
  return readers;
}

std::vector<std::pair<std::string, double>> TableReader::flat_numbers(const std::string& key) {
  TableReader reader = table(
      key, "a table of parameters of the contact law to change, e.g. {adhesion = {force = 0}}", Need::optional);
  std::vector<std::pair<std::string, double>> found;
  if (!reader) return found;
  for (const auto& [name, node] : *reader.table_) {
    const std::string part(name.str());
    if (node.is_table()) {
      for (auto& [below, value] : reader.flat_numbers(part))
        found.emplace_back(fmt::format("{}.{}", part, below), value);
    } else if (const auto value = reader.number(part, {[](double) { return true; }, "a finite number"})) {
      found.emplace_back(part, *value);
    }
  }
  return found;
}

std::vector<double> TableReader::numbers(const std::string& key, NumberRule rule) {
  std::vector<double> values;
  const toml::node* node = find(key, rule.expectation, Need::optional);
  if (!node) return values;
  const toml::array* array = node->as_array();
  for (std::size_t i = 0; array && i < array->size(); ++i) {
    const auto value = finite_number(*array->get(i));
    if (!value || !rule.holds(*value)) break;
    values.push_back(*value);
  }
  if (!array || array->empty() || values.size() != array->size()) {
    refuse_value(key, *node, rule.expectation);
    values.clear();
  }
  return values;
}

std::optional<std::pair<int, int>> TableReader::whole_interval(const std::string& key,
                                                               const char* expectation) {
  const toml::node* node = find(key, expectation, Need::optional);
  if (!node) return std::nullopt;
  const auto whole = [](const toml::node& n) {
    const auto value = n.is_integer() ? std::optional(n.as_integer()->get()) : std::nullopt;
    return value && std::in_range<int>(*value) ? std::optional(static_cast<int>(*value)) : std::nullopt;
  };
  const toml::array* array = node->as_array();
  const bool is_pair = array && array->size() == 2;
  const std::optional<int> least = is_pair ? whole(*array->get(0)) : whole(*node);
  const std::optional<int> most = is_pair ? whole(*array->get(1)) : least;
  if (least && most) return std::pair(*least, *most);
  refuse_value(key, *node, expectation);
  return std::nullopt;
}

std::vector<std::string> TableReader::texts(const std::string& key, const char* expectation) {
  std::vector<std::string> values;
  const toml::node* node = find(key, expectation, Need::optional);
  if (!node) return values;
  const toml::array* array = node->as_array();
  if (!array || array->empty() || !array->is_homogeneous(toml::node_type::string)) {
    refuse_value(key, *node, expectation);
    return values;
  }
  for (const toml::node& value : *array) values.push_back(value.as_string()->get());
  return values;
}

void TableReader::refuse_other_keys() {
  if (!table_) return;
  for (const auto& [name, node] : *table_) {
    const std::string key(name.str());
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    source_->fault(path_of(key), &node,
                   fmt::format("unknown key {}; the nearest valid key {}is {}", path_of(key),
                               path_.empty() ? "" : "in [" + path_ + "] ", nearest_key(key, known_)));
  }
}

}  // namespace floc
