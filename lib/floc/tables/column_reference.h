#pragma once

#include <string>
#include <vector>

namespace floc {

/// Description of a column of a table in docs/columns.md.
struct DescribedColumn {
  std::string name;  ///< name or pattern: "C??" stands for all entries of C
  std::string unit;  ///< unit; empty if there is none, as for a count or a name
  std::string meaning;
};

/// Description of a table that commands print or write.
struct DescribedTable {
  /// Name of the command, with the option that writes the table, such as "moduli --increments".
  std::string name;
  std::vector<std::string> on_terminal;  ///< columns shown on a terminal, in order of priority; all if empty
  std::vector<DescribedColumn> columns;
};

/// Returns the descriptions of all tables in docs/columns.md, the text of which is compiled into the library.
const std::vector<DescribedTable>& described_tables();

/// Returns the description with the fewest columns that includes all given columns; nullptr if there is none.
const DescribedTable* table_with(const std::vector<std::string>& columns);

/// Returns whether a name matches a pattern with the wildcards `*` and `?`.
bool stands_for(const std::string& pattern, const std::string& name);

}  // namespace floc
