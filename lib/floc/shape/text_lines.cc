#include "floc/shape/text_lines.h"

#include <fmt/format.h>

#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"

namespace floc {

TextLines::TextLines(std::string place, std::string_view text, std::string_view separators)
    : place_(std::move(place)), rest_(without_byte_order_mark(text)), separators_(" \t\r\f\v") {
  require_text(place_, text);
  separators_ += separators;
}

bool TextLines::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    ++line_;
    line = line.substr(0, line.find('#'));
    words_.clear();
    for (std::size_t at = line.find_first_not_of(separators_); at != std::string_view::npos;) {
      const std::size_t stop = line.find_first_of(separators_, at);
      words_.push_back(line.substr(at, stop == std::string_view::npos ? stop : stop - at));
      at = stop == std::string_view::npos ? stop : line.find_first_not_of(separators_, stop);
    }
    if (!words_.empty()) return true;
  }
  return false;
}

void TextLines::require_next(const std::string& what) {
  if (!next()) throw InputError(place_, "the file ends too early: expected " + what);
}

std::string TextLines::where() const {
  return fmt::format("{}:{}", place_, line_);
}

void TextLines::refuse(const std::string& problem) const {
  throw InputError(where(), problem);
}

double TextLines::number(std::size_t k) const {
  if (k >= words_.size())
    refuse(
        fmt::format("the line has only {} words: expected a finite number as word {}", words_.size(), k + 1));
  const auto value = parse_number<double>(words_[k]);
  if (!value)
    refuse(fmt::format("\"{}\": expected a finite number{}", words_[k].substr(0, 40),
                       decimal_comma_hint(words_[k])));
  return *value;
}

int TextLines::whole(std::size_t k, const WholeRange& range) const {
  if (k >= words_.size())
    refuse(
        fmt::format("the line has only {} words: expected {} as word {}", words_.size(), range.words(), k + 1));
  const auto value = parse_number<std::int64_t>(words_[k]);
  if (!value || !range.holds(*value))
    refuse(fmt::format("\"{}\": expected {}", words_[k].substr(0, 40), range.words()));
  return static_cast<int>(*value);
}

}  // namespace floc
