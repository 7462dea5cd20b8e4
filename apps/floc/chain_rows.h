#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/chain.h"
#include "floc/io/table.h"

namespace floc {

/// What `floc chain` is asked.
struct ChainCommand {
  int n = 0;
  double R = 0.0;
  ChainStiffness k{};
  double bend = 0.0;  ///< degrees
  std::string format;
};

/// One compliance: what it is, its closed form if the chain is straight, and the network's answer.
struct ChainRow {
  std::string name;
  double formula;
  BoundedValue solved;
};

std::vector<ChainRow> chain_rows(const ChainCommand& command);

/// The table of the rows: no value where double precision leaves no digit of it.
Table chain_table(const ChainCommand& command, const std::vector<ChainRow>& rows);

}  // namespace floc
