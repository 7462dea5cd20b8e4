#include "floc/structure/gap_coordination.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "floc/neighbors/pairs.h"

namespace floc {

template <int Dim>
std::vector<double> gap_coordination(const Packing<Dim>& packing, const std::vector<double>& gaps) {
  assert(std::is_sorted(gaps.begin(), gaps.end()));
  std::vector<double> z(gaps.size(), 0.0);
  const Grains<Dim>& g = packing.grains;
  if (gaps.empty() || g.size() == 0) return z;
  // Pairs at exactly the largest gap belong to it.
  const double reach =
      gaps.back() + 4.0 * std::numeric_limits<double>::epsilon() *
                        (gaps.back() + 2.0 * *std::max_element(g.radius.begin(), g.radius.end()));
  for (const NeighborPair<Dim>& pair : find_pairs(packing.cell, g, reach)) {
    const Vec<Dim> r = g.position[pair.j] + packing.cell.shift(pair.image) - g.position[pair.i];
    const double gap = r.norm() - g.radius[pair.i] - g.radius[pair.j];
    const auto first = std::lower_bound(gaps.begin(), gaps.end(), gap);
    if (first != gaps.end()) z[static_cast<std::size_t>(first - gaps.begin())] += 2.0 / g.size();
  }
  for (std::size_t k = 1; k < z.size(); ++k) z[k] += z[k - 1];
  return z;
}

template std::vector<double> gap_coordination(const Packing<2>&, const std::vector<double>&);
template std::vector<double> gap_coordination(const Packing<3>&, const std::vector<double>&);

}  // namespace floc
