#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "floc/geometry/cell.h"

namespace floc {

/// Finds the periodic copies of an object that reach into the periodic cell. The cell consists of the points whose
/// reduced coordinates are in [0, 1). The cell may be slanted, and smaller than the object.
template <int Dim>
class PeriodicCopies {
 public:
  explicit PeriodicCopies(const Cell<Dim>& cell)
      : cell_(cell), reciprocal_(cell.matrix.transpose().inverse()), reach_(reciprocal_.rowwise().norm()) {}

  /// Calls `draw(shift)` for each periodic copy of an object that reaches into the cell, where `shift` is the
  /// displacement of the copy from the object. The object is the convex hull of two disks (3D: balls) of equal radius
  /// with centres `from` and `to` (length).
  template <class Draw>
  void of_segment(const Vec<Dim>& from, const Vec<Dim>& to, double radius, Draw&& draw) const {
    const Vec<Dim> a = reciprocal_ * from, b = reciprocal_ * to;
    of_extent(a.cwiseMin(b), a.cwiseMax(b), radius, draw);
  }

  /// Calls `draw(shift)` for each periodic copy of an object that reaches into the cell. The object is the convex hull
  /// of disks (3D: balls) of equal radius with their centres at the given points.
  /// @pre there is at least one point
  template <class Draw>
  void of_points(const std::vector<Vec<Dim>>& points, double radius, Draw&& draw) const {
    Vec<Dim> low = reciprocal_ * points.front(), high = low;
    for (const Vec<Dim>& x : points) {
      const Vec<Dim> s = reciprocal_ * x;
      low = low.cwiseMin(s).eval();
      high = high.cwiseMax(s).eval();
    }
    of_extent(low, high, radius, draw);
  }

  template <class Draw>
  void of_disk(const Vec<Dim>& centre, double radius, Draw&& draw) const {
    of_segment(centre, centre, radius, std::forward<Draw>(draw));
  }

 private:
  /// Calls `draw(shift)` for each periodic copy of an object that reaches into the cell. The object consists of disks
  /// or balls of the given radius (length). The reduced coordinates of their centres are between `low_centre` and
  /// `high_centre`.
  template <class Draw>
  void of_extent(const Vec<Dim>& low_centre, const Vec<Dim>& high_centre, double radius, Draw& draw) const {
    const Vec<Dim> low = low_centre - radius * reach_;
    const Vec<Dim> high = high_centre + radius * reach_;
    for (int m = first(high[0]); m <= last(low[0]); ++m)
      for (int n = first(high[1]); n <= last(low[1]); ++n)
        if constexpr (Dim == 2)
          draw(cell_.shift({m, n}));
        else
          for (int k = first(high[2]); k <= last(low[2]); ++k) draw(cell_.shift({m, n, k}));
  }

  static int first(double high) { return static_cast<int>(std::ceil(-high)); }
  static int last(double low) { return static_cast<int>(std::floor(1.0 - low)); }

  Cell<Dim> cell_;
  Mat<Dim> reciprocal_;  ///< matrix whose product with a point gives the reduced coordinates of the point
  /// Change of each reduced coordinate from the centre of a ball of radius 1 to its outermost point.
  Vec<Dim> reach_;
};

}  // namespace floc
