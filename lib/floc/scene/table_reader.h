#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/scene/scene_source.h"

namespace floc {

/// Condition that a real number in a scene must satisfy: a function that tests the number, and a description for
/// messages, for example "a positive number (K_N, force per length)".
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

/// Condition that a whole number in a scene must satisfy: its smallest and largest value, and a description for
/// messages.
struct IntegerRule {
  std::int64_t at_least, at_most;
  const char* expectation;
};

/// Reads the keys of one table of a scene. The reader records which keys it has read, so that all other keys of the
/// table can be reported as unknown. If a value is missing or invalid, the reader records a fault in the SceneSource
/// (it throws nothing) and returns no value. A reader of a missing table returns no values and records no faults.
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
  /// Reads the value of a key, which has to be one of the keywords in `choices`, and returns the index of this keyword.
  /// @param choices  all keywords that the key accepts
  std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& choices,
                                    Need need = Need::required);
  TableReader table(const std::string& key, const char* expectation, Need need = Need::required);
  /// Returns one reader for each table in the array that is the value of a key. The result is empty if the key is
  /// missing.
  std::vector<TableReader> tables(const std::string& key, const char* expectation);
  /// Returns the numbers in the table that is the value of a key. Each number is returned with its own key in this
  /// table. The keys of numbers in inner tables are written with dots, for example "adhesion.force".
  std::vector<std::pair<std::string, double>> flat_numbers(const std::string& key);
  /// Returns the numbers in the array that is the value of a key. The array must contain at least one number, and each
  /// number must satisfy the rule. The result is empty if the key is missing or its value is invalid.
  std::vector<double> numbers(const std::string& key, NumberRule rule);

  /// Returns the smallest and the largest whole number of an interval. The value of the key is an array of these two
  /// numbers, or one whole number that is both ends of the interval.
  std::optional<std::pair<int, int>> whole_interval(const std::string& key, const char* expectation);

  /// Returns the texts in the array that is the value of a key. The result is empty if the key is missing or its value
  /// is invalid.
  std::vector<std::string> texts(const std::string& key, const char* expectation);

  /// Records a fault at a key of this table. If the table does not have the key, the fault is recorded at the table
  /// itself.
  void fault(const std::string& key, const std::string& problem);

  /// Records a fault if the table has a key that is allowed in other scenes but not in this one.
  void refuse(const std::string& key, const std::string& problem);

  /// Records a fault for every key of the table that has not been read. The message names the most similar key among
  /// those that have been read.
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
