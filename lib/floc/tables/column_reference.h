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
  std::vector<std::string> on_terminal;  ///< columns shown there, most wanted first; empty: all
  std::vector<DescribedColumn> columns;
};

/// THE reference of all tables: docs/columns.md, which is compiled in.
const std::vector<DescribedTable>& described_tables();

/// The smallest table that describes all of these columns; nullptr if there is none.
const DescribedTable* table_with(const std::vector<std::string>& columns);

/// Whether a name is one that a pattern of `*` and `?` stands for.
bool stands_for(const std::string& pattern, const std::string& name);

}  // namespace floc
