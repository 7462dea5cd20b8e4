#include "floc/io/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "floc/base/decimal.h"
#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"

namespace floc {
namespace {

/// Cells of one line. `place` names the line in messages.
std::vector<std::string> split(const std::string& place, std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (bool more = true; more;) {
    std::string cell;
    line.remove_prefix(std::min(line.find_first_not_of(separator == '\t' ? " " : " \t"), line.size()));
    if (line.starts_with('"')) {
      std::size_t at = 1;
      for (; at < line.size() && !(line[at] == '"' && (at + 1 == line.size() || line[at + 1] != '"')); ++at) {
        cell += line[at];
        if (line[at] == '"') ++at;
      }
      if (at >= line.size()) throw InputError(place, "a quoted cell does not end");
      line.remove_prefix(at + 1);
    }
    const std::size_t end = line.find(separator);
    cell += trimmed(line.substr(0, end));
    more = end != std::string_view::npos;
    line.remove_prefix(more ? end + 1 : line.size());
    cells.push_back(std::move(cell));
  }
  return cells;
}

/// Up to here every integer is a double, and a real number that is whole was meant.
constexpr double kExactIntegers = 9007199254740992.0;  // 2^53

char separator_of(std::string_view header) {
  for (const char candidate : {',', '\t', ';'})
    if (header.find(candidate) != std::string_view::npos) return candidate;
  return ',';
}

}  // namespace

CsvTable::CsvTable(std::string place, std::vector<std::string> columns)
    : place_(std::move(place)), columns_(std::move(columns)) {}

void CsvTable::add_row(int line, const std::vector<std::string>& cells) {
  if (cells.size() != columns_.size())
    throw InputError(fmt::format("{}:{}", place_, line),
                     fmt::format("has {} cells, expected {} as in the header of the csv table", cells.size(),
                                 columns_.size()));
  lines_.push_back(line);
  for (const std::string& cell : cells) cells_.push_back(cell);
}

CsvTable CsvTable::read(const std::string& path) {
  if (path == "-") return parse("stdin", std::cin);
  std::istringstream in(read_file(path));
  return parse(path, in);
}

CsvTable CsvTable::parse(const std::string& place, std::istream& in) {
  CsvTable table;
  table.place_ = place;
  char separator = ',';
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string here = fmt::format("{}:{}", place, ++number);
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    if (table.columns_.empty()) {
      separator = separator_of(line);
      table.columns_ = split(here, line, separator);
      continue;
    }
    table.add_row(number, split(here, line, separator));
  }
  if (number == 0) throw InputError(place, "is empty, expected a table whose first line names its columns");
  if (table.columns_.empty()) throw InputError(place, "has no header: the first line names the columns");
  return table;
}

bool CsvTable::has(const std::string& name) const {
  return std::find(columns_.begin(), columns_.end(), name) != columns_.end();
}

int CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end())
    throw InputError(place_,
                     fmt::format("has no column \"{}\"; its columns are {}", name, fmt::join(columns_, ", ")));
  if (const auto second = std::find(found + 1, columns_.end(), name); second != columns_.end())
    throw InputError(place_,
                     fmt::format("columns {} and {} are both named \"{}\": rename or remove one of them",
                                 found - columns_.begin() + 1, second - columns_.begin() + 1, name));
  return static_cast<int>(found - columns_.begin());
}

double CsvTable::number(int row, int column) const {
  if (const auto value = parse_number<double>(cell(row, column))) return *value;
  throw InputError(place(row),
                   fmt::format("{} = \"{}\", expected a finite number", columns_[column], cell(row, column)));
}

DoubleDouble CsvTable::double_double_number(int row, int column) const {
  return decimal(cell(row, column), number(row, column));
}

std::int64_t CsvTable::integer(int row, int column) const {
  if (const auto value = parse_number<std::int64_t>(cell(row, column))) return *value;
  if (const auto real = parse_number<double>(cell(row, column)); real && std::abs(*real) <= kExactIntegers)
    if (const auto value = whole_number(*real)) return *value;
  throw InputError(place(row),
                   fmt::format("{} = \"{}\", expected an integer", columns_[column], cell(row, column)));
}

std::string CsvTable::place(int row) const {
  return fmt::format("{}:{}", place_, lines_[row]);
}

}  // namespace floc
