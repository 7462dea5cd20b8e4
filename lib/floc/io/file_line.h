#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

namespace floc {

/// Where one of many things in a file is, for messages: the text before its number, which all of them share,
/// and that number. A file may hold millions.
class FileLine {
 public:
  FileLine() = default;
  /// @param before  "file:" of a line, "array, point " of an entry
  FileLine(std::shared_ptr<const std::string> before, int number)
      : before_(std::move(before)), number_(number) {}

  std::string text() const { return before_ ? fmt::format("{}{}", *before_, number_) : std::string(); }

 private:
  std::shared_ptr<const std::string> before_;
  int number_ = 0;
};

}  // namespace floc
