#include "floc/elasticity/parallel/grain_shares.h"

#include <algorithm>
#include <cassert>
#include <span>

namespace floc {
namespace {

/// Groups of at most this number of grains are not sorted, because the data of so few grains fit into a cache.
constexpr std::size_t kLeaf = 32;

/// Moves the `n_low` grains with the lowest coordinates to the front. The coordinates are measured along the longest
/// side of the box around all given grains.
/// @param n_low  number of grains to move to the front
template <int Dim>
void split(const std::vector<Vec<Dim>>& centres, std::span<int> grains, std::size_t n_low) {
  Vec<Dim> low = centres[grains.front()], high = low;
  for (const int g : grains) {
    low = low.cwiseMin(centres[g]);
    high = high.cwiseMax(centres[g]);
  }
  Eigen::Index side = 0;
  (high - low).maxCoeff(&side);
  const auto is_lower = [&](int g, int h) {
    const double a = centres[g][side], b = centres[h][side];
    return a != b ? a < b : g < h;
  };
  std::nth_element(grains.begin(), grains.begin() + static_cast<std::ptrdiff_t>(n_low), grains.end(), is_lower);
}

/// Sorts grains by recursive bisection of space. First the grains are divided among the processes. Then the grains of
/// each process are halved until the groups have at most kLeaf grains.
/// @param first  receives the index of the first grain of each process
template <int Dim>
void divide(const std::vector<Vec<Dim>>& centres, std::span<int> grains, std::span<int> first) {
  const std::size_t n_processes = first.size();
  if (n_processes <= 1 && grains.size() <= kLeaf) return;
  const std::size_t low_processes = n_processes / 2;
  const std::size_t n_low = n_processes > 1 ? grains.size() * low_processes / n_processes : grains.size() / 2;
  if (grains.size() > 1 && n_low < grains.size()) split(centres, grains, n_low);
  if (n_processes > 1)
    for (int& start : first.subspan(low_processes)) start += static_cast<int>(n_low);
  divide(centres, grains.first(n_low), first.first(low_processes));
  divide(centres, grains.subspan(n_low), first.subspan(low_processes));
}

}  // namespace

template <int Dim>
GrainShares share_out(const std::vector<Vec<Dim>>& centres, const std::vector<bool>& taken, int n_processes) {
  assert(n_processes >= 1 && taken.size() == centres.size());
  GrainShares shares;
  for (int g = 0; g < static_cast<int>(taken.size()); ++g)
    if (taken[g]) shares.grain.push_back(g);
  shares.first.assign(n_processes, 0);
  divide<Dim>(centres, shares.grain, shares.first);
  shares.first.push_back(static_cast<int>(shares.grain.size()));
  shares.block.assign(centres.size(), -1);
  for (int b = 0; b < static_cast<int>(shares.grain.size()); ++b) shares.block[shares.grain[b]] = b;
  return shares;
}

template GrainShares share_out(const std::vector<Vec<2>>&, const std::vector<bool>&, int);
template GrainShares share_out(const std::vector<Vec<3>>&, const std::vector<bool>&, int);

}  // namespace floc
