#pragma once

#include <string>
#include <vector>

namespace floc {

/// Description of a column of a table, as docs/columns.md gives it.
struct DescribedColumn {
  /// name of the column; or a pattern with the wildcards `*` and `?`, such as "C??", for several columns
  std::string name;
  std::string unit;  ///< unit; empty for a column without unit, such as a count or a name
  std::string meaning;
};

/// Description of a table that a command of floc prints or writes.
struct DescribedTable {
  /// Name of the command, with the option that writes the table, such as "moduli --increments".
  std::string name;
  /// Columns that are shown on a terminal, the most important first; if empty, all columns are shown.
  std::vector<std::string> on_terminal;
  std::vector<DescribedColumn> columns;
};

/// Returns the descriptions of all tables, from docs/columns.md. The text of this file is compiled into the library.
const std::vector<DescribedTable>& described_tables();

/// Returns the description of the table that has all the given columns. If several tables have them, returns the table
/// with the fewest columns; if no table has them, nullptr.
const DescribedTable* table_with(const std::vector<std::string>& columns);

/// Returns whether a name matches a pattern with the wildcards `*` and `?`.
bool stands_for(const std::string& pattern, const std::string& name);

}  // namespace floc
