#pragma once

#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Distribution of the grains over processes by position. A block consists of the rows of the stiffness matrix that
/// belong to one grain. Each process has consecutive blocks. Grains of one process are neighbours in space, and so are
/// grains of consecutive blocks.
struct GrainShares {
  std::vector<int> grain;  ///< for each block, the number of its grain
  std::vector<int> block;  ///< for each grain, the number of its block; -1 if the grain has no block
  std::vector<int> first;  ///< first block of each process, then the total number of blocks

  int n_processes() const { return static_cast<int>(first.size()) - 1; }
};

/// Distributes grains over processes by recursive bisection: a group of grains and its processes are divided into two
/// halves, across the longest side of the box around the grains. The numbers of grains in the halves are proportional
/// to the numbers of processes. All processes compute the same distribution, because grains with equal coordinates are
/// sorted by their numbers.
/// @param centres      centres of all grains, inside or outside the cell (length)
/// @param taken        for each grain, whether it gets a block
/// @param n_processes  number of processes, >= 1
template <int Dim>
GrainShares share_out(const std::vector<Vec<Dim>>& centres, const std::vector<bool>& taken, int n_processes);

}  // namespace floc
