#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "floc/io/file_line.h"

namespace floc {

/// Splits a line into words, which are separated by white space. The words are views of the line.
std::vector<std::string_view> words_of(std::string_view line);

/// One line of a text file, split into words. In many formats a line consists of keys, each followed by its values. The
/// text of the line must exist as long as this object.
class KeyedLine {
 public:
  /// @param file  text before the number of the line in messages, "file:"
  KeyedLine(std::shared_ptr<const std::string> file, int number, std::string_view text);

  const FileLine& file_line() const { return line_; }
  std::string place() const { return line_.text(); }
  bool empty() const { return words_.empty(); }
  std::size_t size() const { return words_.size(); }
  std::string_view word(std::size_t k) const { return words_[k]; }
  bool has(std::string_view key) const { return find(key) < words_.size(); }

  /// Returns the number at position `k` of the line.
  /// @param what  name of the value in messages
  /// @throws InputError naming file, line and value if the number is missing or not finite; for integer(), also if it
  /// is not whole
  double number(std::size_t k, std::string_view what) const;
  std::int64_t integer(std::size_t k, std::string_view what) const;
  /// Returns the three numbers at the positions `k`, `k` + 1 and `k` + 2.
  Eigen::Vector3d vector(std::size_t k, std::string_view what) const;

  /// Returns the values after a key. @throws InputError also if the line does not contain the key
  double number(std::string_view key) const { return number(position(key) + 1, key); }
  std::int64_t integer(std::string_view key) const { return integer(position(key) + 1, key); }
  Eigen::Vector3d vector(std::string_view key) const { return vector(position(key) + 1, key); }

  /// Returns the position of a key in the line. @throws InputError if the line does not contain the key
  std::size_t position(std::string_view key) const;

 private:
  std::size_t find(std::string_view key) const;

  FileLine line_;
  std::vector<std::string_view> words_;
};

}  // namespace floc
