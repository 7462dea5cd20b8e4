#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "floc/io/file_line.h"

namespace floc {

/// Reads a text file of LMGC90 line by line. The current line is a view of the text.
class DatFile {
 public:
  explicit DatFile(const std::string& path);

  /// Advances to the next line that is neither empty nor a comment. @return whether there is one
  bool next();
  std::vector<std::string_view> words() const;
  FileLine file_line() const { return {before_number_, number_}; }
  std::string place() const { return file_line().text(); }
  /// Whether the current line is the last one and has no line feed, as in a file that is cut within a line.
  bool is_cut() const { return rest_.empty() && !text_.empty() && text_.back() != '\n'; }

  bool has(std::string_view key) const { return line_.find(key) != std::string_view::npos; }

  /// Returns the number that follows `key` and an optional equals sign. As in output of Fortran, the exponent may begin
  /// with D, and the blank before the number may be missing.
  /// @throws InputError if the line does not contain `key`, or if no number follows
  double number(std::string_view key) const;

 private:
  std::shared_ptr<const std::string> before_number_;
  std::string text_;
  std::string_view rest_;
  std::string_view line_;
  int number_ = 0;
};

}  // namespace floc
