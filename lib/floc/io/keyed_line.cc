#include "floc/io/keyed_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"

namespace floc {

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kSpace = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSpace, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kSpace, end);
  }
  return words;
}

KeyedLine::KeyedLine(std::shared_ptr<const std::string> file, int number, std::string_view text)
    : line_(std::move(file), number), words_(words_of(text)) {}

double KeyedLine::number(std::size_t k, std::string_view what) const {
  const auto value = k < words_.size() ? parse_number<double>(words_[k]) : std::nullopt;
  if (value) return *value;
  throw InputError(place(), fmt::format("{} is \"{}\", expected a finite number", what,
                                        k < words_.size() ? words_[k] : std::string_view("missing")));
}

std::int64_t KeyedLine::integer(std::size_t k, std::string_view what) const {
  if (const auto value = whole_number(number(k, what))) return *value;
  throw InputError(place(), fmt::format("{} is \"{}\", expected a whole number", what, words_[k]));
}

Eigen::Vector3d KeyedLine::vector(std::size_t k, std::string_view what) const {
  return {number(k, what), number(k + 1, what), number(k + 2, what)};
}

std::size_t KeyedLine::position(std::string_view key) const {
  const std::size_t k = find(key);
  if (k < words_.size()) return k;
  throw InputError(place(), fmt::format("the line has no {}", key));
}

std::size_t KeyedLine::find(std::string_view key) const {
  return static_cast<std::size_t>(std::find(words_.begin(), words_.end(), key) - words_.begin());
}

}  // namespace floc
