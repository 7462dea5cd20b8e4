#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

namespace floc {

/// Place of one of many items in a file, for messages: the text before its number, shared by all items, and the
/// number. The text is shared because a file may hold millions of items.
class FileLine {
 public:
  FileLine() = default;
  /// @param before  text before the number: "file:" for a line, "array, point " for an entry
  FileLine(std::shared_ptr<const std::string> before, int number)
      : before_(std::move(before)), number_(number) {}

  std::string text() const { return before_ ? fmt::format("{}{}", *before_, number_) : std::string(); }

 private:
  std::shared_ptr<const std::string> before_;
  int number_ = 0;
};

}  // namespace floc
