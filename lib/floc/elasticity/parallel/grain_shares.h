#pragma once

#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Grains shared out among processes by position. Each process has consecutive blocks of rows, one per grain;
/// the grains of one process are neighbours in space, and so are consecutive ones.
struct GrainShares {
  std::vector<int> grain;  ///< grain of each block
  std::vector<int> block;  ///< block of each grain; -1 if it has none
  std::vector<int> first;  ///< first block of each process, and the end

  int n_processes() const { return static_cast<int>(first.size()) - 1; }
};

/// Shares grains out by recursive bisection across the longest side, each time in proportion to the numbers of
/// processes on both sides. The result is the same on every process: ties are broken by the number of the
/// grain.
/// @param centres      of all grains, in the cell or not (length)
/// @param taken        one entry per grain: whether it gets a block
/// @param n_processes  >= 1
template <int Dim>
GrainShares share_out(const std::vector<Vec<Dim>>& centres, const std::vector<bool>& taken, int n_processes);

}  // namespace floc
