#include "floc/shape/plane_manifold.h"

#include <algorithm>

namespace floc {
namespace {

ContactType type_of(int n_points, int dim) {
  if (n_points <= 1) return ContactType::kVertexFace;
  return dim == 3 && n_points == 2 ? ContactType::kDouble : ContactType::kFaceFace;
}

}  // namespace

template <int Dim>
Manifold<Dim> plane_manifold(const PlacedShape<Dim>& shape, const Vec<Dim>& normal, double offset,
                             double reach) {
  Manifold<Dim> found;
  found.normal = normal;
  for (int v = 0; v < std::max(1, shape.shape->n_vertices()); ++v) {
    const Vec<Dim> vertex = shape.scale * (shape.rotation * core_vertex(*shape.shape, v));
    const double gap = offset - normal.dot(shape.position + vertex) - shape.rounding();
    if (gap < reach)
      found.points.push_back(
          {vertex + (shape.rounding() + 0.5 * gap) * normal, gap, static_cast<std::uint32_t>(v)});
  }
  found.type = type_of(found.n(), Dim);
  return found;
}

template Manifold<2> plane_manifold(const PlacedShape<2>&, const Vec<2>&, double, double);
template Manifold<3> plane_manifold(const PlacedShape<3>&, const Vec<3>&, double, double);

}  // namespace floc
