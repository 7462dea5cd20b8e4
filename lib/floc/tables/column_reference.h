#pragma once

#include <string>
#include <vector>

namespace floc {

/// A column as docs/columns.md describes it.
struct DescribedColumn {
  std::string name;  ///< may be a pattern: "C??" stands for all entries of C
  std::string unit;  ///< empty: none, such as of a count or a name
  std::string meaning;
};

/// A table that commands print or write.
struct DescribedTable {
  std::string name;                      ///< "moduli", "fit elastic", "moduli --increments"
  std::vector<std::string> on_terminal;  ///< columns shown on a terminal, in order of priority; empty: all
  std::vector<DescribedColumn> columns;
};

/// Returns the reference of all tables: docs/columns.md, which is compiled into the library.
const std::vector<DescribedTable>& described_tables();

/// Returns the table with the fewest columns that describes all of these; nullptr if there is none.
const DescribedTable* table_with(const std::vector<std::string>& columns);

/// Returns whether a name matches a pattern of `*` and `?`.
bool stands_for(const std::string& pattern, const std::string& name);

}  // namespace floc
