#include "floc/tables/verification_row.h"

namespace floc {

void add_verification_row(const std::string& file, const std::vector<Criterion>& criteria, Table& table) {
  std::string failed;
  for (const Criterion& c : criteria)
    if (!c.holds) failed += (failed.empty() ? "" : " ") + std::string(c.name);
  if (table.columns.empty()) {
    table.columns = {"file", "equilibrium", "failed"};
    for (const Criterion& c : criteria) table.columns.emplace_back(c.name);
  }
  auto& row = table.rows.emplace_back();
  row.emplace_back(file);
  row.emplace_back(failed.empty());
  row.push_back(or_undefined(failed));
  for (const Criterion& c : criteria) row.push_back(or_undefined(c.value));
}

}  // namespace floc
