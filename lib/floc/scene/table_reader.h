#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/scene/scene_source.h"

namespace floc {

/// Requirement on a real number: a function that tests it, and its description for messages, for example "a positive
/// number (K_N, force per length)".
struct NumberRule {
  bool (*holds)(double);
  const char* expectation;
};
constexpr bool positive(double x) {
  return x > 0;
}
constexpr bool not_negative(double x) {
  return x >= 0;
}

/// Requirement on a whole number: its limits, and their description for messages.
struct IntegerRule {
  std::int64_t at_least, at_most;
  const char* expectation;
};

/// Reads the keys of one table of a scene. It remembers which keys were read, so that every other key can be reported
/// as a fault. Faults are recorded in the SceneSource, not thrown, and the function that finds one returns no value. A
/// reader of a missing table returns no values and records no faults.
class TableReader {
 public:
  enum class Need { required, optional };

  explicit TableReader(SceneSource& source) : source_(&source), table_(&source.root()) {}
  TableReader(SceneSource& source, const toml::table* table, std::string path)
      : source_(&source), table_(table), path_(std::move(path)) {}

  explicit operator bool() const { return table_ != nullptr; }
  const std::string& path() const { return path_; }
  /// Returns the path of a key from the root of the scene, for example "grains.count".
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  bool has(const std::string& key) const { return table_ && table_->contains(key); }
  std::optional<double> number(const std::string& key, NumberRule rule, Need need = Need::required);
  std::optional<std::int64_t> integer(const std::string& key, IntegerRule rule, Need need = Need::required);
  std::optional<std::string> text(const std::string& key, const char* expectation, Need need = Need::required);
  /// Returns the index of the value of a key in the list `choices`, which holds all accepted values.
  std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& choices,
                                    Need need = Need::required);
  TableReader table(const std::string& key, const char* expectation, Need need = Need::required);
  /// Returns one reader for each table of an array of tables; the result is empty if the key is missing.
  std::vector<TableReader> tables(const std::string& key, const char* expectation);
  /// Returns the numbers in a table, by their keys. The keys of tables inside it are written with dots, for example
  /// "adhesion.force".
  std::vector<std::pair<std::string, double>> flat_numbers(const std::string& key);
  /// Returns an array of at least one number, in which each number satisfies the rule. The result is empty if the key
  /// is missing or its value is invalid.
  std::vector<double> numbers(const std::string& key, NumberRule rule);

  /// Returns an array of texts. The result is empty if the key is missing or its value is invalid.
  std::vector<std::string> texts(const std::string& key, const char* expectation);

  /// Records a fault about a key of this table, or about the table itself if it does not have the key.
  void fault(const std::string& key, const std::string& problem);

  /// Records a fault if the table has this key, for keys that are valid only in other scenes.
  void refuse(const std::string& key, const std::string& problem);

  /// Records a fault for every key that was not read. The message names the most similar key that is valid in this
  /// table.
  void refuse_other_keys();

 private:
  const toml::node* find(const std::string& key, const char* expectation, Need need);
  void refuse_value(const std::string& key, const toml::node& node, const std::string& expectation);

  SceneSource* source_;
  const toml::table* table_;
  std::string path_;
  std::vector<std::string> known_;
};

}  // namespace floc
