#include "floc/shape/plane_manifold.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace floc {
namespace {

/// Returns the first point with the largest value of `size`.
template <int Dim, class Size>
const ManifoldPoint<Dim>& largest(const std::vector<ManifoldPoint<Dim>>& points, const Size& size) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const auto& p, const auto& q) { return size(p) < size(q); });
}

/// Returns all points if there are at most Manifold::kMostPoints. Otherwise returns at most four points that enclose a
/// large area, and the point with the wanted key.
template <int Dim>
std::vector<ManifoldPoint<Dim>> spread_out(const std::vector<ManifoldPoint<Dim>>& all, const Vec<Dim>& normal,
                                           std::optional<std::uint32_t> wanted) {
  using Point = ManifoldPoint<Dim>;
  if (static_cast<int>(all.size()) <= Manifold<Dim>::kMostPoints) return all;
  const Point deepest = largest<Dim>(all, [](const Point& p) { return -p.gap; });
  const Point furthest = largest<Dim>(all, [&](const Point& p) { return (p.arm - deepest.arm).squaredNorm(); });
  std::vector<Point> kept = {deepest, furthest};
  if constexpr (Dim == 3) {
    const Vec<3> across = normal.cross(furthest.arm - deepest.arm);
    for (const double side : {1.0, -1.0}) {
      const auto distance = [&](const Point& p) { return side * across.dot(p.arm - deepest.arm); };
      const Point outermost = largest<Dim>(all, distance);
      if (distance(outermost) > 0.0) kept.push_back(outermost);
    }
  }
  const auto is_wanted = [&](const Point& p) { return wanted && p.key == *wanted; };
  if (const auto left_out = std::ranges::find_if(all, is_wanted);
      left_out != all.end() && std::ranges::none_of(kept, is_wanted)) {
    if (static_cast<int>(kept.size()) == Manifold<Dim>::kMostPoints) kept.pop_back();
    kept.push_back(*left_out);
  }
  std::sort(kept.begin(), kept.end(), [](const Point& p, const Point& q) { return p.key < q.key; });
  return kept;
}

ContactType type_of(int n_points, int dim) {
  if (n_points <= 1) return ContactType::kVertexFace;
  return dim == 3 && n_points == 2 ? ContactType::kDouble : ContactType::kFaceFace;
}

}  // namespace

template <int Dim>
Manifold<Dim> plane_manifold(const PlacedShape<Dim>& shape, const Vec<Dim>& normal, double offset, double reach,
                             std::optional<std::uint32_t> wanted) {
  std::vector<ManifoldPoint<Dim>> near;
  for (int v = 0; v < std::max(1, shape.shape->n_vertices()); ++v) {
    const Vec<Dim> vertex = shape.scale * (shape.rotation * core_vertex(*shape.shape, v));
    const double gap = offset - normal.dot(shape.position + vertex) - shape.rounding();
    if (gap < reach)
      near.push_back({vertex + (shape.rounding() + 0.5 * gap) * normal, gap, static_cast<std::uint32_t>(v)});
  }
  Manifold<Dim> found;
  found.normal = normal;
  for (const ManifoldPoint<Dim>& point : spread_out<Dim>(near, normal, wanted)) found.points[found.n++] = point;
  found.type = type_of(found.n, Dim);
  return found;
}

template Manifold<2> plane_manifold(const PlacedShape<2>&, const Vec<2>&, double, double,
                                    std::optional<std::uint32_t>);
template Manifold<3> plane_manifold(const PlacedShape<3>&, const Vec<3>&, double, double,
                                    std::optional<std::uint32_t>);

}  // namespace floc
