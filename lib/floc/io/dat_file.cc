#include "floc/io/dat_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/io/keyed_line.h"

namespace floc {

DatFile::DatFile(const std::string& path)
    : before_number_(std::make_shared<const std::string>(path + ":")), text_(read_text(path)), rest_(text_) {}

bool DatFile::next() {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (!trimmed(line_).empty() && !trimmed(line_).starts_with('!')) return true;
  }
  return false;
}

std::vector<std::string_view> DatFile::words() const {
  return words_of(line_);
}

double DatFile::number(std::string_view key) const {
  const std::size_t at = line_.find(key);
  if (at == std::string_view::npos) throw InputError(place(), fmt::format("the line has no \"{}\"", key));
  const std::string_view after = line_.substr(at + key.size());
  const std::vector<std::string_view> rest =
      words_of(after.substr(std::min(after.find_first_not_of(" ="), after.size())));
  std::string text(rest.empty() ? "" : rest.front());
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  if (const auto value = parse_number<double>(text)) return *value;
  throw InputError(place(), fmt::format("{} is \"{}\", expected a finite number", key,
                                        rest.empty() ? std::string_view("missing") : rest.front()));
}

}  // namespace floc
