#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "floc/base/vec.h"
#include "floc/packing/grain_sizes.h"

namespace floc {

/// Rectangular region in which grains are placed. Along each axis it is either periodic or bounded by walls.
template <int Dim>
struct Room {
  Vec<Dim> side;
  std::array<bool, Dim> walled = {};
};

/// Hard grains in a rectangular region. To find close grains fast, the region is divided into a grid of bins, and each
/// bin lists the grains in it. If the largest diameter is much larger than the smallest, there are several grids, such
/// that the diameters of the grains in one grid differ by less than a factor of two. The bins of a grid are at least as
/// long as the diameter of its largest grain, unless the region is shorter.
template <int Dim>
class HardGrains {
 public:
  HardGrains(const Room<Dim>& room, const std::vector<double>& diameter)
      : room_(room), diameter_(diameter), grid_of_(diameter.size(), 0), position_(diameter.size()) {
    const auto [least, most] = std::minmax_element(diameter.begin(), diameter.end());
    if (*most > kSimilarSizes * *least)
      for (std::size_t i = 0; i < diameter.size(); ++i) grid_of_[i] = std::ilogb(*most / diameter[i]);
    grids_.resize(*std::max_element(grid_of_.begin(), grid_of_.end()) + 1);
    for (std::size_t i = 0; i < diameter.size(); ++i) {
      Grid& grid = grids_[grid_of_[i]];
      grid.largest = std::max(grid.largest, diameter[i]), ++grid.n_grains;
    }
    for (Grid& grid : grids_)
      if (grid.n_grains > 0) divide(grid);
  }

  const Room<Dim>& room() const { return room_; }

  /// Returns true if grain i, with its centre at x and all diameters multiplied by `scale`, overlaps no other placed
  /// grain: clearance(i, x, scale) >= 1.
  bool free_at(int i, const Vec<Dim>& x, double scale) const {
    bool free = true;
    visit_near(i, x, [&](int j, const Vec<Dim>& r) {
      const double touching = 0.5 * scale * (diameter_[i] + diameter_[j]);
      // Most grains are far apart, and the square root for their exact distance is not needed.
      if (r.squaredNorm() < kSurelyApart * touching * touching) free = r.norm() / touching >= 1.0;
      return free;
    });
    return free;
  }

  /// For each other grain j, let q be the distance between the centres of the grains i and j, divided by the sum of
  /// their radii. Returns the smallest q. The centre of i is at x, and all diameters are multiplied by `scale` <= 1. A
  /// result above 1 only means that grain i overlaps no other grain; its value may be inexact.
  double clearance(int i, const Vec<Dim>& x, double scale) const {
    double least = 2.0;
    visit_near(i, x, [&](int j, const Vec<Dim>& r) {
      least = std::min(least, r.norm() / (0.5 * scale * (diameter_[i] + diameter_[j])));
      return true;
    });
    return least;
  }

  /// Calls visit(j, r) for every grain j that grain i, with its centre at x, might touch, and for some grains farther
  /// away. The calls end when `visit` returns false. The vector r leads from x to the centre of grain j.
  template <typename Visit>
  void visit_near(int i, const Vec<Dim>& x, Visit&& visit) const {
    for (const Grid& grid : grids_) {
      if (grid.n_grains == 0) continue;
      const double reach = 0.5 * (diameter_[i] + grid.largest);
      const Vec<Dim, int> centre = bin_of(x, grid);
      Vec<Dim, int> most;
      // Half of the bins of a side in each direction are together all bins of the side. More bins are never visited.
      for (int a = 0; a < Dim; ++a)
        most[a] = std::min(grid.bins[a] / 2, static_cast<int>(std::ceil(reach / room_.side[a] * grid.bins[a])));
      // The order of the offsets along an axis is 0, 1, -1, 2, -2, ..., because a grain that ends the search is most
      // often in one of the nearest bins.
      Vec<Dim, int> offset = Vec<Dim, int>::Zero();
      int a = 0;
      while (a < Dim) {
        for (const int j : grid.members[flat(centre + offset, grid)])
          if (j != i && !visit(j, nearest_image(position_[j] - x))) return;
        for (a = 0; a < Dim; offset[a] = 0, ++a) {
          offset[a] = offset[a] > 0 ? -offset[a] : 1 - offset[a];
          if (offset[a] <= most[a]) break;
        }
      }
    }
  }

  Vec<Dim> nearest_image(Vec<Dim> r) const {
    // Most components are shorter than half of the side of the region; no division is needed for them.
    for (int a = 0; a < Dim; ++a)
      if (!room_.walled[a] && std::abs(r[a]) > kSurelyNearest * room_.side[a])
        r[a] -= room_.side[a] * std::round(r[a] / room_.side[a]);
    return r;
  }

  void place(int i, const Vec<Dim>& x) {
    position_[i] = x;
    bin_at(i, x).push_back(i);
  }

  void move(int i, const Vec<Dim>& x) {
    auto& old = bin_at(i, position_[i]);
    old.erase(std::find(old.begin(), old.end(), i));
    place(i, x);
  }

  const std::vector<Vec<Dim>>& position() const { return position_; }

 private:
  /// kSurelyApart: let q be the squared distance of the centres of two grains, divided by the squared sum of their
  /// radii. If q is at least this number, the grains do not overlap, in spite of rounding errors.
  /// kSurelyNearest: let q be a component of a vector, divided by the side of the region. If |q| is at most this
  /// number, no periodic image of the vector has a shorter component.
  static constexpr double kSurelyApart = 1.0 + 1e-9, kSurelyNearest = 0.499;

  struct Grid {
    double largest = 0.0;  ///< largest diameter of the grains in this grid (length)
    int n_grains = 0;
    Vec<Dim, int> bins;  ///< number of bins along each side of the region
    std::vector<std::vector<int>> members;
  };

  void divide(Grid& grid) const {
    // The number of bins is limited: with many more bins than grains, empty bins would use memory without saving time.
    const double most_bins = 2.0 * std::pow(static_cast<double>(grid.n_grains), 1.0 / Dim) + 1.0;
    std::size_t n_bins = 1;
    for (int a = 0; a < Dim; ++a) {
      grid.bins[a] = static_cast<int>(std::clamp(room_.side[a] / grid.largest, 1.0, most_bins));
      n_bins *= static_cast<std::size_t>(grid.bins[a]);
    }
    grid.members.resize(n_bins);
  }

  Vec<Dim, int> bin_of(const Vec<Dim>& x, const Grid& grid) const {
    Vec<Dim, int> bin;
    for (int a = 0; a < Dim; ++a)
      bin[a] = std::min(grid.bins[a] - 1, static_cast<int>(x[a] / room_.side[a] * grid.bins[a]));
    return bin;
  }
  /// Returns the index of a bin in Grid::members. The numbers in `bin` are periodic: along an axis with n bins, the
  /// bins -1 and n are the bins n - 1 and 0. Numbers from -n to 2 n - 1 are allowed.
  std::size_t flat(const Vec<Dim, int>& bin, const Grid& grid) const {
    std::size_t index = 0;
    for (int a = 0; a < Dim; ++a) {
      const int n = grid.bins[a];
      const int inside = bin[a] < 0 ? bin[a] + n : bin[a] >= n ? bin[a] - n : bin[a];
      index = index * static_cast<std::size_t>(n) + static_cast<std::size_t>(inside);
    }
    return index;
  }
  std::vector<int>& bin_at(int i, const Vec<Dim>& x) {
    Grid& grid = grids_[grid_of_[i]];
    return grid.members[flat(bin_of(x, grid), grid)];
  }

  Room<Dim> room_;
  std::vector<double> diameter_;
  std::vector<int> grid_of_;
  std::vector<Grid> grids_;
  std::vector<Vec<Dim>> position_;
};

}  // namespace floc
