#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/chain.h"
#include "floc/io/table.h"

namespace floc {

/// A chain of equal disks.
struct ChainOptions {
  int n = 0;           ///< number of disks
  double R = 0.0;      ///< radius of the disks (length)
  ChainStiffness k{};  ///< stiffnesses of the contacts
  double bend = 0.0;   ///< angle between each branch and the one before (degrees)
};

/// One compliance of a chain.
struct ChainRow {
  std::string name;
  double formula;       ///< closed form of a straight chain
  BoundedValue solved;  ///< solution of the contact network, with a bound of its error
};

/// Computes the compliances of a chain.
std::vector<ChainRow> chain_rows(const ChainOptions& chain);

/// Returns the rows as a table. A value is left empty if double precision keeps no digit of it.
Table chain_table(const ChainOptions& chain, const std::vector<ChainRow>& rows);

}  // namespace floc
