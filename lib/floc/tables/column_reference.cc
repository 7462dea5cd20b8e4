#include "floc/tables/column_reference.h"

#include <fnmatch.h>

#include <algorithm>
#include <sstream>

#include "column_text.h"
#include "floc/base/split.h"

namespace floc {
namespace {

constexpr std::string_view kHeading = "## ";
constexpr std::string_view kOnTerminal = "On a terminal: ";

/// Parses docs/columns.md. In this file, the headings are the names of tables, the lines "On a terminal: ..." list the
/// columns that are shown on a terminal, and the rows "| name | unit | meaning |" describe the columns.
std::vector<DescribedTable> parse_reference(const std::string& text) {
  std::vector<DescribedTable> tables;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kHeading)) tables.push_back({line.substr(kHeading.size()), {}, {}});
    if (tables.empty()) continue;
    if (line.starts_with(kOnTerminal))
      tables.back().on_terminal = split(std::string_view(line).substr(kOnTerminal.size()), ',');
    if (!line.starts_with("| ") || line.starts_with("| column |")) continue;
    const std::vector<std::string> cells = split(line, '|');  // cell 0, before the first bar, is empty
    tables.back().columns.push_back({cells.at(1), cells.at(2), cells.at(3)});
  }
  return tables;
}

bool describes(const DescribedTable& table, const std::string& column) {
  return std::ranges::any_of(table.columns,
                             [&](const DescribedColumn& c) { return stands_for(c.name, column); });
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

}  // namespace floc
