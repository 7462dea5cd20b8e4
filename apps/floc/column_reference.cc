#include "column_reference.h"

#include <fnmatch.h>

#include <algorithm>
#include <iostream>
#include <sstream>

#include "column_text.h"
#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/base/parse_number.h"
#include "output.h"

namespace floc {
namespace {

constexpr std::string_view kHeading = "## ";
constexpr std::string_view kOnTerminal = "On a terminal: ";

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

/// Reads the headings, the lines "On a terminal" and the rows "| name | unit | meaning |".
std::vector<DescribedTable> parse_reference(const std::string& text) {
  std::vector<DescribedTable> tables;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kHeading)) tables.push_back({line.substr(kHeading.size()), {}, {}});
    if (tables.empty()) continue;
    if (line.starts_with(kOnTerminal))
      tables.back().on_terminal = split(std::string_view(line).substr(kOnTerminal.size()), ',');
    if (!line.starts_with("| ") || line.starts_with("| column |")) continue;
    const std::vector<std::string> cells = split(line, '|');  // an empty one before the first bar
    tables.back().columns.push_back({cells.at(1), cells.at(2), cells.at(3)});
  }
  return tables;
}

bool describes(const DescribedTable& table, const std::string& column) {
  return std::ranges::any_of(table.columns,
                             [&](const DescribedColumn& c) { return stands_for(c.name, column); });
}

/// Those that `name` names.
std::vector<DescribedTable> tables_named(const std::string& name) {
  std::vector<DescribedTable> found;
  std::vector<std::string> names;
  for (const DescribedTable& table : described_tables()) {
    names.push_back(table.name);
    if (name.empty() || table.name == name || table.name.starts_with(name + " ")) found.push_back(table);
  }
  if (found.empty())
    throw InputError("floc help columns", "no table is named \"" + name + "\"; the nearest is \"" +
                                              nearest_name(name, names) + "\"");
  return found;
}

}  // namespace

const std::vector<DescribedTable>& described_tables() {
  static const std::vector<DescribedTable> tables = parse_reference(kColumnText);
  return tables;
}

const DescribedTable* table_with(const std::vector<std::string>& columns) {
  const DescribedTable* smallest = nullptr;
  for (const DescribedTable& table : described_tables())
    if (std::ranges::all_of(columns, [&](const std::string& c) { return describes(table, c); }) &&
        (smallest == nullptr || table.columns.size() < smallest->columns.size()))
      smallest = &table;
  return smallest;
}

bool stands_for(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

void print_column_reference(const std::string& name, const std::string& format) {
  const std::vector<DescribedTable> tables = tables_named(name);
  Table all{{"table", "column", "unit", "meaning"}, {}};
  for (const DescribedTable& table : tables)
    for (const DescribedColumn& c : table.columns)
      all.rows.push_back({table.name, c.name, or_undefined(c.unit), c.meaning});
  if (chosen_format(format) != TableFormat::table) return print_table(all, format);
  for (const DescribedTable& table : tables) {
    Table one{{"column", "unit", "meaning"}, {}};
    for (const DescribedColumn& c : table.columns) one.rows.push_back({c.name, c.unit, c.meaning});
    std::cout << (&table == tables.data() ? "" : "\n") << table.name << "\n\n";
    write_table(std::cout, one, TableFormat::table);
  }
  std::cout.flush();
  if (!std::cout) throw IoError("standard output", "cannot be written");
}

}  // namespace floc
