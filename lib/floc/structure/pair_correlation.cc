#include "floc/structure/pair_correlation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "floc/neighbors/pairs.h"

namespace floc {
namespace {

/// Volume of a ball of radius r (area of a disk in 2D).
template <int Dim>
double ball(double r) {
  return std::numbers::pi * r * r * (Dim == 2 ? 1.0 : 4.0 / 3.0 * r);
}

}  // namespace

template <int Dim>
PairCorrelation pair_correlation(const Packing<Dim>& packing, double reach, int n_bins) {
  assert(reach > 0.0 && n_bins >= 1);
  PairCorrelation out;
  out.width = reach / n_bins;
  out.g.assign(n_bins, 0.0);
  out.n_pairs.assign(n_bins, 0);
  const int n = packing.grains.size();
  if (n == 0) return out;
  Grains<Dim> points = packing.grains;
  std::fill(points.radius.begin(), points.radius.end(), 0.0);
  for (const NeighborPair<Dim>& pair : find_pairs(packing.cell, points, reach)) {
    const Vec<Dim> r = points.position[pair.j] + packing.cell.shift(pair.image) - points.position[pair.i];
    ++out.n_pairs[std::min(n_bins - 1, static_cast<int>(r.norm() / out.width))];
  }
  const double density = n / packing.cell.volume();
  for (int b = 0; b < n_bins; ++b)
    out.g[b] = 2.0 * static_cast<double>(out.n_pairs[b]) /
               (n * density * (ball<Dim>((b + 1) * out.width) - ball<Dim>(b * out.width)));
  return out;
}

template PairCorrelation pair_correlation(const Packing<2>&, double, int);
template PairCorrelation pair_correlation(const Packing<3>&, double, int);

}  // namespace floc
