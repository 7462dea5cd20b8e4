#include "floc/tables/verification_row.h"

#include <algorithm>
#include <utility>

namespace floc {

void add_verification_row(const std::string& file, const std::vector<Criterion>& criteria, Table& table) {
  std::string failed;
  for (const Criterion& c : criteria)
    if (!c.holds) failed += (failed.empty() ? "" : " ") + std::string(c.name);
  if (table.columns.empty()) table.columns = {"file", "equilibrium", "failed"};
  // States of elastic grains and states of rigid grains have different criteria. A table with both kinds of states has
  // the columns of both kinds.
  std::vector<TableValue> row(table.columns.size());
  row[0] = file;
  row[1] = failed.empty();
  row[2] = or_undefined(failed);
  for (const Criterion& c : criteria) {
    const auto column =
        static_cast<std::size_t>(std::ranges::find(table.columns, c.name) - table.columns.begin());
    if (column == table.columns.size()) {
      table.columns.emplace_back(c.name);
      row.emplace_back();
      for (std::vector<TableValue>& earlier : table.rows) earlier.emplace_back();
    }
    row[column] = or_undefined(c.value);
  }
  table.rows.push_back(std::move(row));
}

}  // namespace floc
