#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/chain.h"
#include "floc/io/table.h"

namespace floc {

/// A chain of equal disks.
struct ChainOptions {
  int n = 0;       ///< disks
  double R = 0.0;  ///< their radius (length)
  ChainStiffness k{};
  double bend = 0.0;  ///< degrees by which each branch is turned against the one before
};

/// One compliance: what it is, its closed form if the chain is straight, and the network's answer.
struct ChainRow {
  std::string name;
  double formula;
  BoundedValue solved;
};

std::vector<ChainRow> chain_rows(const ChainOptions& chain);

/// The table of the rows: no value where double precision leaves no digit of it.
Table chain_table(const ChainOptions& chain, const std::vector<ChainRow>& rows);

}  // namespace floc
