#include "floc/io/table_cells.h"

#include <algorithm>

#include "floc/base/parse_number.h"

namespace floc {
namespace {

/// Removes a quoted cell from the beginning of `line`, and stores its text in `cell`. @return false if the closing
/// quotation mark is missing
bool take_quoted(std::string_view& line, std::string& cell) {
  std::size_t at = 1;
  for (; at < line.size() && !(line[at] == '"' && (at + 1 == line.size() || line[at + 1] != '"')); ++at) {
    if (line[at] != '\r') cell += line[at] == '\n' ? ' ' : line[at];
    if (line[at] == '"') ++at;
  }
  if (at >= line.size()) return false;
  line.remove_prefix(at + 1);
  return true;
}

}  // namespace

std::optional<std::vector<std::string>> split_cells(std::string_view line, char separator) {
  const bool blanks = separator == ' ';
  const std::string_view separators = blanks ? " \t" : std::string_view(&separator, 1);
  if (blanks) line = trimmed(line);
  std::vector<std::string> cells;
  for (bool more = true; more;) {
    std::string cell;
    line.remove_prefix(std::min(line.find_first_not_of(separator == '\t' ? " " : " \t"), line.size()));
    if (line.starts_with('"') && !take_quoted(line, cell)) return std::nullopt;
    const std::size_t end = line.find_first_of(separators);
    cell += trimmed(line.substr(0, end));
    more = end != std::string_view::npos;
    line.remove_prefix(more ? end + 1 : line.size());
    cells.push_back(std::move(cell));
  }
  return cells;
}

std::string with_decimal_point(std::string_view text) {
  std::string number(trimmed(text));
  const std::size_t comma = number.find(',');
  if (comma == std::string::npos) return "";
  number[comma] = '.';
  return parse_number<double>(number) ? number : "";
}

bool is_number(std::string_view cell, bool decimal_commas) {
  return parse_number<double>(cell).has_value() || (decimal_commas && !with_decimal_point(cell).empty());
}

std::size_t without_trailing_empties(const std::vector<std::string>& cells) {
  std::size_t n = cells.size();
  while (n > 0 && cells[n - 1].empty()) --n;
  return n;
}

}  // namespace floc
