#include "floc/shape/point_memory.h"

namespace floc {

template <int Dim>
std::vector<int> matched_points(std::span<const ManifoldPoint<Dim>> now,
                                std::span<const ManifoldPoint<Dim>> before, double radius) {
  std::vector<int> match(now.size(), -1), claimed_by(before.size(), -1);
  for (std::size_t k = 0; k < now.size(); ++k)
    for (std::size_t l = 0; l < before.size(); ++l)
      if (now[k].key == before[l].key) {
        match[k] = static_cast<int>(l);
        claimed_by[l] = static_cast<int>(k);
      }
  for (;;) {
    double least = radius * radius;
    int nearest = -1, to = -1;
    for (std::size_t k = 0; k < now.size(); ++k)
      for (std::size_t l = 0; l < before.size(); ++l) {
        if (match[k] >= 0 || claimed_by[l] >= 0) continue;
        const double distance2 = (now[k].arm - before[l].arm).squaredNorm();
        if (distance2 <= least && (distance2 < least || nearest < 0))
          least = distance2, nearest = static_cast<int>(k), to = static_cast<int>(l);
      }
    if (nearest < 0) return match;
    match[static_cast<std::size_t>(nearest)] = to;
    claimed_by[static_cast<std::size_t>(to)] = nearest;
  }
}

template std::vector<int> matched_points(std::span<const ManifoldPoint<2>>, std::span<const ManifoldPoint<2>>,
                                         double);
template std::vector<int> matched_points(std::span<const ManifoldPoint<3>>, std::span<const ManifoldPoint<3>>,
                                         double);

}  // namespace floc
