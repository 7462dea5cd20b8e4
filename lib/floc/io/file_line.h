#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

namespace floc {

/// Place in a file, for messages: a line, or an entry of an array. A place consists of a text and the number of the
/// line or entry. All places in a file share one copy of the text, because a file may have millions of lines.
class FileLine {
 public:
  FileLine() = default;
  /// @param before  text before the number: "file:" for a line of a file, "array, point " for an entry of an array
  /// @param number  number of the line or entry
  FileLine(std::shared_ptr<const std::string> before, int number)
      : before_(std::move(before)), number_(number) {}

  std::string text() const { return before_ ? fmt::format("{}{}", *before_, number_) : std::string(); }

 private:
  std::shared_ptr<const std::string> before_;
  int number_ = 0;
};

}  // namespace floc
