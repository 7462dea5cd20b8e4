#pragma once

#include <string>
#include <vector>

#include "floc/elasticity/chain.h"
#include "floc/io/table.h"

namespace floc {

/// A chain of equal disks, whose compliances are computed.
struct ChainOptions {
  int n = 0;           ///< number of disks
  double R = 0.0;      ///< radius of the disks (length)
  ChainStiffness k{};  ///< stiffnesses of the contacts
  /// angle (degrees) between successive segments of the line through the centres of the disks; 0: straight chain
  double bend = 0.0;
};

/// A compliance of a chain of disks, with two values: one from a closed formula, the other from a numerical solution.
struct ChainRow {
  std::string name;
  double formula;  ///< compliance by the closed formula for a straight chain
  /// Compliance by the numerical solution of the contact network, with a bound on the error of the solution.
  BoundedValue solved;
};

/// Computes the compliances of a chain of disks.
std::vector<ChainRow> chain_rows(const ChainOptions& chain);

/// Returns the table of `floc chain`, with a row for each compliance. If rounding in double precision leaves no correct
/// digit in a numerical solution, its two cells (value and error bound) are empty.
Table chain_table(const ChainOptions& chain, const std::vector<ChainRow>& rows);

}  // namespace floc
