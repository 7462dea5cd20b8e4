#include "floc/neighbors/nearest_pair.h"

#include <algorithm>

#include "floc/neighbors/pairs.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/locate.h"

namespace floc {

namespace {

/// Returns the gap of two grains whose circumscribed circles or spheres have a gap of at most `reach`.
template <int Dim>
double gap_of(const Packing<Dim>& packing, const Contact<Dim>& c, double reach) {
  if (packing.grains.are_round()) return locate(packing, c).gap;
  const double largest = reach + packing.grains.radius[c.i] + packing.grains.radius[c.j];
  return std::min(largest, manifold_of(packing, c, branch(packing, c), largest).least_gap());
}

}  // namespace

template <int Dim>
std::optional<NearestPair> nearest_pair(const Packing<Dim>& packing) {
  // Neighbours are searched up to a largest gap, which increases from search to search. kFirst and kLast are the first
  // and the last largest gap, divided by the largest diameter.
  constexpr double kFirst = 1e-3, kLast = 1e3;
  const double a = largest_diameter(packing.grains);
  const double farthest = std::min(kLast * a, packing.cell.matrix.cwiseAbs().sum());
  for (double reach = kFirst * a; reach < 2.0 * farthest; reach *= 2.0) {
    std::optional<NearestPair> nearest;
    const Cell<Dim> cell = search_cell(packing.cell, packing.walls, a + reach);
    for (const NeighborPair<Dim>& pair : find_pairs(cell, packing.grains, reach)) {
      Contact<Dim> c;
      c.i = pair.i, c.j = pair.j, c.image = pair.image;
      const double gap = gap_of(packing, c, reach);
      if (!nearest || gap < nearest->gap) nearest = {c.i, c.j, gap};
    }
    // The gap of two grains with corners can exceed the gap of their circumscribed circles or spheres. Pairs that were
    // not found have larger gaps than `reach`.
    if (nearest && nearest->gap <= reach) return nearest;
  }
  return std::nullopt;
}

template std::optional<NearestPair> nearest_pair(const Packing<2>&);
template std::optional<NearestPair> nearest_pair(const Packing<3>&);

}  // namespace floc
