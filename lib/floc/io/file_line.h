#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

namespace floc {

/// Place of one item of a file, such as a line, for messages. It consists of a text and the number of the item. All
/// items of a file share the text, because a file may hold millions of items.
class FileLine {
 public:
  FileLine() = default;
  /// @param before  text before the number: "file:" for a line of a file, "array, point " for an entry of an array
  FileLine(std::shared_ptr<const std::string> before, int number)
      : before_(std::move(before)), number_(number) {}

  std::string text() const { return before_ ? fmt::format("{}{}", *before_, number_) : std::string(); }

 private:
  std::shared_ptr<const std::string> before_;
  int number_ = 0;
};

}  // namespace floc
