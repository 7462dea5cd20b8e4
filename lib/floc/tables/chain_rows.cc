#include "floc/tables/chain_rows.h"

#include <numbers>

namespace floc {

std::vector<ChainRow> chain_rows(const ChainOptions& c) {
  const SolvedChain solved = solve_chain(bent_chain(c.n, c.bend * std::numbers::pi / 180.0), c.R, c.k);
  return {{"axial", chain_axial_compliance(c.n, c.k), solved.axial},
          {"transverse", chain_transverse_compliance(c.n, c.R, c.k), solved.transverse},
          {"rolling", chain_rolling_compliance(c.n, c.k), solved.rolling},
          {"end_disk_deflection", end_disk_deflection(c.n, c.R, c.k), solved.end_disk}};
}

Table chain_table(const ChainOptions& c, const std::vector<ChainRow>& rows) {
  Table table;
  table.columns = {"n", "R", "kn", "kt", "kr", "bend", "compliance", "formula", "solved", "error_bound"};
  for (const ChainRow& row : rows) {
    const bool resolved = row.solved.resolved();
    table.rows.push_back({std::int64_t{c.n}, c.R, c.k.normal, c.k.tangential, c.k.rolling, c.bend, row.name,
                          c.bend == 0.0 ? TableValue{row.formula} : TableValue{},
                          resolved ? TableValue{row.solved.value} : TableValue{},
                          resolved ? TableValue{row.solved.error} : TableValue{}});
  }
  return table;
}

}  // namespace floc
