#include "floc/structure/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "floc/base/interruption.h"

namespace floc {
namespace {

double wedge(const Vec<2>& p, const Vec<2>& q) {
  return p[0] * q[1] - p[1] * q[0];
}

double sector(double R, const Vec<2>& p, const Vec<2>& q) {
  return 0.5 * R * R * std::atan2(wedge(p, q), p.dot(q));
}

/// Returns the signed area that a disk of radius R about the origin shares with the triangle (origin, p, q).
double fan_overlap(double R, const Vec<2>& p, const Vec<2>& q) {
  const Vec<2> along = q - p;
  const double length2 = along.squaredNorm();
  if (length2 == 0.0) return 0.0;
  const double middle = -p.dot(along) / length2;
  const double half2 = middle * middle - (p.squaredNorm() - R * R) / length2;
  if (half2 <= 0.0) return sector(R, p, q);
  const double half = std::sqrt(half2);
  const double enter = middle - half, leave = middle + half;
  if (leave <= 0.0 || enter >= 1.0) return sector(R, p, q);
  const Vec<2> first = enter > 0.0 ? Vec<2>(p + enter * along) : p;
  const Vec<2> last = leave < 1.0 ? Vec<2>(p + leave * along) : q;
  double area = 0.5 * wedge(first, last);
  if (enter > 0.0) area += sector(R, p, first);
  if (leave < 1.0) area += sector(R, last, q);
  return area;
}

int wrapped_index(int k, int n) {
  return (k % n + n) % n;
}

/// Adds disks one by one to a map of the solid fraction.
class Painter {
 public:
  Painter(const Cell<2>& cell, const Vec<2, int>& size)
      : cell_(cell),
        map_{size, std::vector<double>(static_cast<std::size_t>(size[0]) * size[1], 0.0)},
        edge1_(cell.matrix.row(0).transpose() / size[0]),
        edge2_(cell.matrix.row(1).transpose() / size[1]),
        area_(std::abs(wedge(edge1_, edge2_))),
        circumradius_(0.5 * std::max((edge1_ + edge2_).norm(), (edge1_ - edge2_).norm())) {
    const Mat<2> to_reduced = cell.matrix.transpose().inverse();
    for (int a = 0; a < 2; ++a) reach_[a] = to_reduced.row(a).norm() * size[a];
    // Corners of a mesh cell relative to its centre, counter-clockwise even if the lattice vectors are left-handed.
    const bool right = wedge(edge1_, edge2_) > 0.0;
    const Vec<2>&u = right ? edge1_ : edge2_, &v = right ? edge2_ : edge1_;
    corners_ = {Vec<2>(-0.5 * (u + v)), Vec<2>(0.5 * (u - v)), Vec<2>(0.5 * (u + v)), Vec<2>(0.5 * (v - u))};
  }

  void add(const Vec<2>& centre, double R) {
    const Vec<2> s = cell_.reduced(centre).cwiseProduct(map_.size.cast<double>());
    Vec<2, int> low, high;
    for (int a = 0; a < 2; ++a) {
      low[a] = static_cast<int>(std::floor(s[a] - R * reach_[a]));
      high[a] = static_cast<int>(std::floor(s[a] + R * reach_[a]));
    }
    for (int k1 = low[0]; k1 <= high[0]; ++k1) {
      double* row =
          map_.share.data() + static_cast<std::size_t>(wrapped_index(k1, map_.size[0])) * map_.size[1];
      for (int k2 = low[1]; k2 <= high[1]; ++k2) {
        const Vec<2> at = (k1 + 0.5 - s[0]) * edge1_ + (k2 + 0.5 - s[1]) * edge2_;
        row[wrapped_index(k2, map_.size[1])] += share_at(at, R);
      }
    }
  }

  CoverageMap take() { return std::move(map_); }

 private:
  /// Returns the share of a mesh cell that a disk of radius R covers.
  /// @param at  vector from the centre of the disk to the centre of the mesh cell
  double share_at(const Vec<2>& at, double R) const {
    const double distance2 = at.squaredNorm();
    const double inside = R - circumradius_, outside = R + circumradius_;
    if (distance2 >= outside * outside) return 0.0;
    if (inside > 0.0 && distance2 <= inside * inside) return 1.0;
    double overlap = 0.0;
    for (int c = 0; c < 4; ++c) overlap += fan_overlap(R, at + corners_[c], at + corners_[(c + 1) % 4]);
    return overlap / area_;
  }

  const Cell<2>& cell_;
  CoverageMap map_;
  Vec<2> edge1_, edge2_;
  double area_;
  double circumradius_;
  // for each lattice vector: number of mesh cells along this vector that a unit of length can span
  Vec<2> reach_;
  std::array<Vec<2>, 4> corners_;
};

}  // namespace

double disk_polygon_overlap(double R, const std::vector<Vec<2>>& corners) {
  double overlap = 0.0;
  for (std::size_t c = 0; c < corners.size(); ++c)
    overlap += fan_overlap(R, corners[c], corners[(c + 1) % corners.size()]);
  return overlap;
}

CoverageMap coverage_map(const Packing<2>& packing, const Vec<2, int>& size) {
  for (const int side : size) require_in_range("mesh cells along a lattice vector", side, kPositiveWhole);
  Painter painter(packing.cell, size);
  for (int i = 0; i < packing.grains.size(); ++i) {
    check_interruption();
    painter.add(packing.grains.position[i], packing.grains.radius[i]);
  }
  return painter.take();
}

}  // namespace floc
