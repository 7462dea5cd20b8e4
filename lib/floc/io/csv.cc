#include "floc/io/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "floc/base/decimal.h"
#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"

namespace floc {
namespace {

/// Splits one line of a csv file into its cells. @param place  name of the line in messages
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
      if (at >= line.size()) throw InputError(place, "a quoted cell has no closing quotation mark");
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

/// Largest magnitude of a real number, such as 3.0, that is accepted as an integer. Up to this limit a double
/// represents every integer exactly.
constexpr double kExactIntegers = 9007199254740992.0;  // 2^53

char separator_of(std::string_view header) {
  for (const char candidate : {',', '\t', ';'})
    if (header.find(candidate) != std::string_view::npos) return candidate;
  return ',';
}

/// Returns a likely reason why a row has a wrong number of cells, as the end of the error message; empty if no reason
/// is apparent.
const char* count_hint(const std::vector<std::string>& cells, const CsvTable& table, char separator) {
  const auto is_number = [](const std::string& cell) { return parse_number<double>(cell).has_value(); };
  const std::size_t n_columns = table.columns().size();
  const bool may_be_decimal_commas =
      separator == ',' && cells.size() > n_columns && cells.size() <= 2 * n_columns;
  if (may_be_decimal_commas && std::all_of(cells.begin(), cells.end(), is_number))
    return "; write numbers with a decimal point, not a comma";
  if (table.n_rows() == 0 && std::none_of(cells.begin(), cells.end(), is_number))
    return "; if the line above this one is a title, remove it or put # before it";
  return "";
}

/// Returns a likely reason why a table lacks the column `name`, as the end of the error message; empty if no reason is
/// apparent from the first lines of the table.
std::string header_hint(const CsvTable& table, const std::string& name) {
  const std::vector<std::string>& columns = table.columns();
  if (columns.size() == 1 && columns[0].find_first_of(" \t") != std::string::npos)
    return ": the names of the columns in the first line have to be separated by a comma, semicolon or tab, "
           "not blanks";
  for (int k = 0; k < static_cast<int>(columns.size()) && table.n_rows() > 0; ++k)
    if (table.text(0, k).starts_with(name))
      return fmt::format(
          "; line {} contains this name: if the line above it is a title, remove it or put # before it",
          table.line(0));
  return "";
}

}  // namespace

CsvTable::CsvTable(std::string place, std::vector<std::string> columns)
    : place_(std::move(place)), columns_(std::move(columns)) {}

void CsvTable::add_row(int line, const std::vector<std::string>& cells) {
  if (cells.size() != columns_.size()) refuse_count(line, cells.size(), "");
  lines_.push_back(line);
  for (const std::string& cell : cells) cells_.push_back(cell);
}

void CsvTable::refuse_count(int line, std::size_t n_cells, const char* hint) const {
  throw InputError(fmt::format("{}:{}", place_, line),
                   fmt::format("the line has {} cells, expected {} as in the header of the csv table{}",
                               n_cells, columns_.size(), hint));
}

CsvTable CsvTable::read(const std::string& path) {
  std::istringstream in(read_text(path));
  return parse(path == "-" ? "stdin" : path, in);
}

CsvTable CsvTable::parse(const std::string& place, std::istream& in) {
  CsvTable table;
  table.place_ = place;
  char separator = ',';
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string here = fmt::format("{}:{}", place, ++number);
    if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
    if (table.columns_.empty()) {
      separator = separator_of(line);
      table.columns_ = split(here, line, separator);
      continue;
    }
    const std::vector<std::string> cells = split(here, line, separator);
    if (cells.size() != table.columns_.size())
      table.refuse_count(number, cells.size(), count_hint(cells, table, separator));
    table.add_row(number, cells);
  }
  if (number == 0)
    throw InputError(place, "the file is empty, expected a table whose first line names its columns");
  if (table.columns_.empty())
    throw InputError(place, "the table has no header: its first line has to name the columns");
  return table;
}

bool CsvTable::has(const std::string& name) const {
  return std::find(columns_.begin(), columns_.end(), name) != columns_.end();
}

int CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end())
    throw InputError(place_, fmt::format("the table has no column \"{}\"; its columns are {}{}", name,
                                         fmt::join(columns_, ", "), header_hint(*this, name)));
  if (const auto second = std::find(found + 1, columns_.end(), name); second != columns_.end())
    throw InputError(place_,
                     fmt::format("columns {} and {} are both named \"{}\": rename or remove one of them",
                                 found - columns_.begin() + 1, second - columns_.begin() + 1, name));
  return static_cast<int>(found - columns_.begin());
}

double CsvTable::number(int row, int column) const {
  if (const auto value = parse_number<double>(cell(row, column))) return *value;
  throw InputError(place(row), fmt::format("{} = \"{}\", expected a finite number{}", columns_[column],
                                           cell(row, column), decimal_comma_hint(cell(row, column))));
}

DoubleDouble CsvTable::double_double_number(int row, int column) const {
  return decimal(cell(row, column), number(row, column));
}

std::int64_t CsvTable::integer(int row, int column) const {
  if (const auto value = parse_number<std::int64_t>(cell(row, column))) return *value;
  if (const auto real = parse_number<double>(cell(row, column)); real && std::abs(*real) <= kExactIntegers)
    if (const auto value = whole_number(*real)) return *value;
  throw InputError(place(row), fmt::format("{} = \"{}\", expected an integer{}", columns_[column],
                                           cell(row, column), decimal_comma_hint(cell(row, column))));
}

std::string CsvTable::place(int row) const {
  return fmt::format("{}:{}", place_, lines_[row]);
}

}  // namespace floc
