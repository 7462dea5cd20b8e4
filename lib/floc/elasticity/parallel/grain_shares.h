#pragma once

#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Distribution of the grains over the processes by position. Each process has consecutive blocks of rows of the
/// stiffness matrix, one block per grain. The grains of a process are neighbours in space, and so are grains of
/// consecutive blocks.
struct GrainShares {
  std::vector<int> grain;  ///< number of the grain to which each block belongs
  std::vector<int> block;  ///< number of the block of each grain; -1 if the grain has no block
  std::vector<int> first;  ///< first block of each process, and the total number of blocks

  int n_processes() const { return static_cast<int>(first.size()) - 1; }
};

/// Distributes grains over processes by recursive bisection across the longest side. The numbers of grains on both
/// sides are proportional to the numbers of processes there. The result is the same on every process: ties are broken
/// by the number of the grain.
/// @param centres      centres of all grains, inside or outside the cell (length)
/// @param taken        one entry per grain: whether it gets a block
/// @param n_processes  number of processes, >= 1
template <int Dim>
GrainShares share_out(const std::vector<Vec<Dim>>& centres, const std::vector<bool>& taken, int n_processes);

}  // namespace floc
