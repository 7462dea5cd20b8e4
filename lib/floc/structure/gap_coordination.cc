#include "floc/structure/gap_coordination.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "floc/neighbors/pairs.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Grains touch if their gap is at most this share of the sum of their radii. The gaps of rattlers that were pushed
/// against other grains have rounding errors below this tolerance.
constexpr double kTouching = 1e-12;

}  // namespace

template <int Dim>
std::vector<double> gap_coordination(const Packing<Dim>& packing, const std::vector<double>& gaps) {
  assert(std::is_sorted(gaps.begin(), gaps.end()));
  const Grains<Dim>& g = packing.grains;
  if (gaps.empty() || g.size() == 0) return std::vector<double>(gaps.size(), 0.0);
  std::vector<std::int64_t> n_pairs(gaps.size(), 0);
  // The search includes gaps slightly above the largest gap, so that pairs at exactly this gap are counted.
  const double largest = 0.5 * largest_diameter(g);
  const double reach = gaps.back() * (1.0 + kTouching) + 4.0 * kTouching * largest;
  for (const NeighborPair<Dim>& pair : find_pairs(packing.cell, g, reach, most_pairs_in_memory(g.size()))) {
    const Vec<Dim> r = g.position[pair.j] + packing.cell.shift(pair.image) - g.position[pair.i];
    const double diameter = g.radius[pair.i] + g.radius[pair.j];
    const double gap = r.norm() - diameter * (1.0 + kTouching);
    const auto first = std::lower_bound(gaps.begin(), gaps.end(), gap);
    if (first != gaps.end()) ++n_pairs[static_cast<std::size_t>(first - gaps.begin())];
  }
  std::vector<double> z;
  std::int64_t n = 0;
  for (const std::int64_t more : n_pairs) z.push_back(2.0 * static_cast<double>(n += more) / g.size());
  return z;
}

template std::vector<double> gap_coordination(const Packing<2>&, const std::vector<double>&);
template std::vector<double> gap_coordination(const Packing<3>&, const std::vector<double>&);

}  // namespace floc
