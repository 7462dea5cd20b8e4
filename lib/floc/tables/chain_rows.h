#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/chain.h"
#include "floc/io/table.h"

namespace floc {

/// A chain of equal disks whose compliances are computed.
struct ChainOptions {
  int n = 0;           ///< number of disks
  double R = 0.0;      ///< radius of the disks (length)
  ChainStiffness k{};  ///< stiffnesses of the contacts
  double bend = 0.0;   ///< angle between successive branches of the chain (degrees)
};

/// One compliance of a chain of disks, by formula and by numerical solution.
struct ChainRow {
  std::string name;
  double formula;       ///< compliance of a straight chain in closed form
  BoundedValue solved;  ///< compliance from the solution of the contact network, with a bound of its error
};

/// Computes the compliances of a chain of disks.
std::vector<ChainRow> chain_rows(const ChainOptions& chain);

/// Returns the compliances as a table. A cell is empty if its value has no correct digit in double precision.
Table chain_table(const ChainOptions& chain, const std::vector<ChainRow>& rows);

}  // namespace floc
