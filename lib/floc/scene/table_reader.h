#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/scene/scene_source.h"

namespace floc {

/// What a number has to be: a test, and the same in words ("a positive number (K_N, force per length)").
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

/// What a whole number must be: its limits, and the same in words.
struct IntegerRule {
  std::int64_t at_least, at_most;
  const char* expectation;
};

/// Reads the keys of one table of a scene and remembers which it was asked for, so that every other key is a
/// fault. A fault is recorded, not thrown, and the value is then absent. A reader of a missing table returns
/// no values and adds no further faults.
class TableReader {
 public:
  enum class Need { required, optional };

  explicit TableReader(SceneSource& source) : source_(&source), table_(&source.root()) {}
  TableReader(SceneSource& source, const toml::table* table, std::string path)
      : source_(&source), table_(table), path_(std::move(path)) {}

  explicit operator bool() const { return table_ != nullptr; }
  const std::string& path() const { return path_; }
  /// Path of a key from the root of the scene.
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  bool has(const std::string& key) const { return table_ && table_->contains(key); }
  std::optional<double> number(const std::string& key, NumberRule rule, Need need = Need::required);
  std::optional<std::int64_t> integer(const std::string& key, IntegerRule rule, Need need = Need::required);
  std::optional<std::string> text(const std::string& key, const char* expectation, Need need = Need::required);
  /// Index of the key's value among `choices`.
  std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& choices,
                                    Need need = Need::required);
  TableReader table(const std::string& key, const char* expectation, Need need = Need::required);
  /// One reader for each table of an array of tables; none if the key is missing.
  std::vector<TableReader> tables(const std::string& key, const char* expectation);
  /// Numbers of a table, tables in it flattened to dotted keys.
  std::vector<std::pair<std::string, double>> flat_numbers(const std::string& key);
  /// An array of numbers that all satisfy the rule, at least one; empty if the key is missing or faulty.
  std::vector<double> numbers(const std::string& key, NumberRule rule);

  /// An array of texts; empty if the key is missing or faulty.
  std::vector<std::string> texts(const std::string& key, const char* expectation);

  /// Records a fault about a key of this table, or about the table when it lacks the key.
  void fault(const std::string& key, const std::string& problem);

  /// Records a fault if the table has this key, which is valid only elsewhere.
  void refuse(const std::string& key, const std::string& problem);

  /// Records every key that was not asked for, with the nearest one that is valid here.
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
