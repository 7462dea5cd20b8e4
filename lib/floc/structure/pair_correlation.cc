#include "floc/structure/pair_correlation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "floc/base/error.h"
#include "floc/neighbors/pairs.h"

namespace floc {
namespace {

/// Returns the volume of a ball of radius r (area of a disk in 2D).
template <int Dim>
double ball(double r) {
  return std::numbers::pi * r * r * (Dim == 2 ? 1.0 : 4.0 / 3.0 * r);
}

/// Returns the volume of the part of the cell that is at least `reach` away from every wall.
template <int Dim>
double inner_volume(const Packing<Dim>& packing, double reach) {
  Vec<Dim> side = packing.cell.matrix.diagonal();
  double volume = packing.cell.volume();
  for (int a = 0; a < Dim; ++a)
    if (between_walls(packing.walls, a)) volume *= std::max(0.0, side[a] - 2.0 * reach) / side[a];
  return volume;
}

/// Counts the neighbours of all grains whose distance from every wall is at least `reach`.
/// @return number of these grains
template <int Dim>
int count_away_from_walls(const Packing<Dim>& packing, const Grains<Dim>& points, double reach,
                          PairCorrelation& out) {
  std::vector<bool> is_inner(points.size(), true);
  for (int i = 0; i < points.size(); ++i)
    for (const Wall<Dim>& wall : packing.walls)
      is_inner[i] = is_inner[i] && wall.side * (wall.position - points.position[i][wall.axis]) >= reach;
  const Cell<Dim> cell = search_cell(packing.cell, packing.walls, reach);
  for (const NeighborPair<Dim>& pair : find_pairs(cell, points, reach, most_pairs_in_memory(points.size()))) {
    const Vec<Dim> r = points.position[pair.j] + cell.shift(pair.image) - points.position[pair.i];
    const int b = std::min(static_cast<int>(out.g.size()) - 1, static_cast<int>(r.norm() / out.width));
    out.n_pairs[b] += static_cast<int>(is_inner[pair.i]) + static_cast<int>(is_inner[pair.j]);
  }
  return static_cast<int>(std::count(is_inner.begin(), is_inner.end(), true));
}

template <int Dim>
void require_countable(const Packing<Dim>& packing, double reach, int n_bins) {
  require_in_range("reach", reach, kPositiveNumber);
  require_in_range("n_bins", n_bins, kPositiveWhole);
  const double n = packing.grains.size();
  const double n_pairs = n > 0.0 ? 0.5 * n * n / packing.cell.volume() * ball<Dim>(reach) : 0.0;
  if (!(n_pairs <= kMostPairsInMemory))
    throw InputError("", fmt::format("reach = {} (length): the pair correlation g(r) would have to count "
                                     "{:.2g} pairs, but at most {:.2g} are possible; choose a smaller reach",
                                     reach, n_pairs, kMostPairsInMemory));
}

template <int Dim>
double shell(const PairCorrelation& of, int b) {
  return ball<Dim>((b + 1) * of.width) - ball<Dim>(b * of.width);
}

}  // namespace

template <int Dim>
PairCorrelation pair_correlation(const Packing<Dim>& packing, double reach, int n_bins) {
  require_countable(packing, reach, n_bins);
  PairCorrelation out;
  out.width = reach / n_bins;
  out.g.assign(n_bins, 0.0);
  out.n_pairs.assign(n_bins, 0);
  const int n = packing.grains.size();
  if (n == 0) return out;
  Grains<Dim> points = packing.grains;
  std::fill(points.radius.begin(), points.radius.end(), 0.0);
  if (!packing.walls.empty()) {
    const double n_inner = count_away_from_walls(packing, points, reach, out);
    const double inner_density = n_inner / inner_volume(packing, reach);
    for (int b = 0; b < n_bins; ++b)
      out.g[b] = n_inner > 0
                     ? static_cast<double>(out.n_pairs[b]) / (n_inner * inner_density * shell<Dim>(out, b))
                     : std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  for (const NeighborPair<Dim>& pair :
       find_pairs(packing.cell, points, reach, most_pairs_in_memory(points.size()))) {
    const Vec<Dim> r = points.position[pair.j] + packing.cell.shift(pair.image) - points.position[pair.i];
    ++out.n_pairs[std::min(n_bins - 1, static_cast<int>(r.norm() / out.width))];
  }
  const double density = n / packing.cell.volume();
  for (int b = 0; b < n_bins; ++b)
    out.g[b] = 2.0 * static_cast<double>(out.n_pairs[b]) / (n * density * shell<Dim>(out, b));
  return out;
}

template PairCorrelation pair_correlation(const Packing<2>&, double, int);
template PairCorrelation pair_correlation(const Packing<3>&, double, int);

}  // namespace floc
