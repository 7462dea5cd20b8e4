#include "floc/io/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <iterator>

#include "floc/base/decimal.h"
#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/io/table_cells.h"

namespace floc {
namespace {

/// Up to this magnitude, a double represents every integer exactly. An integer that is written as a real number, such
/// as 3.0, is accepted only up to this magnitude.
constexpr double kExactIntegers = 9007199254740992.0;  // 2^53

/// Returns a likely reason for a wrong number of cells, with which the error message ends. The text is empty if no
/// reason is apparent.
const char* count_hint(const std::vector<std::string>& cells, std::size_t n_columns, char separator) {
  const auto number = [](const std::string& cell) { return is_number(cell, false); };
  const bool may_be_decimal_commas =
      separator == ',' && cells.size() > n_columns && cells.size() <= 2 * n_columns;
  return may_be_decimal_commas && std::all_of(cells.begin(), cells.end(), number)
             ? "; write numbers with a decimal point, not a comma, or separate the cells by semicolons"
             : "";
}

/// Returns the end of the error message about a text that is not a number: a likely reason; empty if no reason is
/// apparent.
std::string number_hint(std::string_view text) {
  if (const std::string hint = decimal_comma_hint(text); !hint.empty() || is_number(text, true)) return hint;
  std::string digits;
  for (const char c : text)
    if (c != ' ' && c != '\'' && c != '.' && c != ',') digits += c;
  return is_number(digits, false) ? " without separators of thousands" : "";
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
                   fmt::format("the line has {} cells, expected {} as in the header of the table{}", n_cells,
                               columns_.size(), hint));
}

CsvTable CsvTable::read(const std::string& path, const std::vector<std::string>& wanted) {
  return of_text(path == "-" ? "stdin" : path, read_table_text(path), wanted);
}

CsvTable CsvTable::parse(const std::string& place, std::istream& in, const std::vector<std::string>& wanted) {
  return of_text(place, decoded_table(place, {std::istreambuf_iterator<char>(in), {}}), wanted);
}

CsvTable CsvTable::of_text(const std::string& place, const TableText& decoded,
                           const std::vector<std::string>& wanted) {
  if (decoded.text.empty())
    throw InputError(place, "the file is empty, expected a table with a line that names its columns");
  const TableLines lines = table_lines(decoded.text);
  CsvTable table;
  table.place_ = place;
  table.encoding_ = decoded.encoding;
  table.layout_ = find_table_layout(lines, wanted);
  if (table.layout_.names.empty())
    throw InputError(place, lines.rows.empty()
                                ? "the table has no header: its first line must name the columns"
                                : "the table has no header: no line above the numbers names the columns");
  table.columns_ = table.layout_.names;
  for (std::size_t i = table.layout_.first_row; i < lines.rows.size(); ++i) table.add_line(lines.rows[i]);
  for (std::vector<std::string>& names : table.layout_.other_names) names.resize(table.columns_.size());
  return table;
}

void CsvTable::add_line(const TableLine& line) {
  auto split = split_cells(line.text, layout_.separator);
  if (!split)
    throw InputError(fmt::format("{}:{}", place_, line.number), "a quoted cell has no closing quotation mark");
  std::vector<std::string> cells = std::move(*split);
  const std::size_t n_filled = without_trailing_empties(cells);
  if (n_filled == 0 && cells.size() > 1)
    return;  // a row of empty cells, which spreadsheets write for a blank row
  // Spreadsheets write the same number of separators in all lines, and thus empty cells at the end of shorter lines.
  // These empty cells are removed.
  if (cells.size() > columns_.size()) cells.resize(std::max(n_filled, columns_.size()));
  if (n_rows() == 0 && cells.size() < columns_.size() && columns_.back().empty())
    columns_.resize(std::max(cells.size(), without_trailing_empties(columns_)));
  if (cells.size() != columns_.size())
    refuse_count(line.number, cells.size(), count_hint(cells, columns_.size(), layout_.separator));
  if (layout_.separator != ',' && decimal_comma_line_ == 0)
    for (const std::string& cell : cells)
      if (decimal_comma_line_ == 0 && !with_decimal_point(cell).empty()) {
        decimal_comma_ = cell;
        decimal_comma_line_ = line.number;
      }
  add_row(line.number, cells);
}

std::string CsvTable::rows_in_words() const {
  return fmt::format("{} row{}", n_rows(), n_rows() == 1 ? "" : "s");
}

std::string CsvTable::unit_cell(int column) const {
  const auto k = static_cast<std::size_t>(column);
  return k < layout_.units.size() ? layout_.units[k] : "";
}

std::string CsvTable::description() const {
  std::vector<std::string> words;
  if (layout_.separator != ',')
    words.push_back(fmt::format("separated by {}", separator_words(layout_.separator)));
  if (decimal_comma_line_ > 0) words.emplace_back("decimal commas");
  if (!encoding_.empty()) words.push_back("encoding " + encoding_);
  if (layout_.last_title_line > 0)
    words.push_back(fmt::format("columns named in line {}, below a title", layout_.names_line));
  if (layout_.units_line > 0) words.push_back(fmt::format("units in line {}", layout_.units_line));
  return fmt::format("{}", fmt::join(words, ", "));
}

bool CsvTable::has(const std::string& name) const {
  return std::find(columns_.begin(), columns_.end(), name) != columns_.end();
}

int CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns_.begin(), columns_.end(), name);
  if (found == columns_.end())
    throw InputError(place_, fmt::format("the table has no column \"{}\"; its columns are {}", name,
                                         fmt::join(columns_, ", ")));
  if (const auto second = std::find(found + 1, columns_.end(), name); second != columns_.end())
    throw InputError(place_,
                     fmt::format("columns {} and {} are both named \"{}\": rename or remove one of them",
                                 found - columns_.begin() + 1, second - columns_.begin() + 1, name));
  return static_cast<int>(found - columns_.begin());
}

std::string CsvTable::number_text(int row, int column) const {
  const std::string_view text = cell(row, column);
  if (decimal_comma_line_ == 0) return std::string(text);
  const std::string number = with_decimal_point(text);
  return number.empty() ? std::string(text) : number;
}

/// Throws if a number has a point although the table has decimal commas: it is not clear whether the point is a decimal
/// mark or separates thousands.
void CsvTable::require_no_point(int row, int column) const {
  if (decimal_comma_line_ == 0) return;
  const std::string_view text = cell(row, column);
  if (text.find('.') == std::string_view::npos || !is_number(text, false)) return;
  throw InputError(
      place(row),
      fmt::format(
          "{} = \"{}\" has a point, but \"{}\" in line {} has a decimal comma: expected one decimal mark in "
          "all numbers, and no separators of thousands",
          columns_[column], cell(row, column), decimal_comma_, decimal_comma_line_));
}

void CsvTable::refuse_cell(int row, int column, const char* expected) const {
  throw InputError(place(row), fmt::format("{} = \"{}\", expected {}{}", columns_[column], cell(row, column),
                                           expected, number_hint(cell(row, column))));
}

double CsvTable::number(int row, int column) const {
  require_no_point(row, column);
  if (const auto value = parse_number<double>(cell(row, column))) return *value;
  if (const auto value = parse_number<double>(number_text(row, column))) return *value;
  refuse_cell(row, column, "a finite number");
}

DoubleDouble CsvTable::double_double_number(int row, int column) const {
  return decimal(number_text(row, column), number(row, column));
}

std::int64_t CsvTable::integer(int row, int column) const {
  require_no_point(row, column);
  if (const auto value = parse_number<std::int64_t>(cell(row, column))) return *value;
  if (const auto real = parse_number<double>(number_text(row, column));
      real && std::abs(*real) <= kExactIntegers)
    if (const auto value = whole_number(*real)) return *value;
  refuse_cell(row, column, "an integer");
}

std::string CsvTable::place(int row) const {
  return fmt::format("{}:{}", place_, lines_[row]);
}

}  // namespace floc
