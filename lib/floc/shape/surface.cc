#include "floc/shape/surface.h"

#include <cmath>

#include "floc/shape/convex_hull.h"

namespace floc {
namespace {

/// Returns the directions of the vertices of an icosahedron and of the midpoints of its edges.
std::vector<Vec<3>> directions() {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec<3>> out;
  for (const double one : {-1.0, 1.0})
    for (const double other : {-golden, golden})
      for (int a = 0; a < 3; ++a)
        out.emplace_back(one * Vec<3>::Unit((a + 1) % 3) + other * Vec<3>::Unit((a + 2) % 3));
  const double edge = 2.0;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((out[i] - out[j]).norm() < 1.01 * edge) out.emplace_back(0.5 * (out[i] + out[j]));
  for (Vec<3>& direction : out) direction.normalize();
  return out;
}

}  // namespace

Polytope<3> surface_of(const Shape<3>& shape) {
  Polytope<3> surface{shape.vertices, {}};
  for (int f = 0; f < shape.n_faces(); ++f)
    surface.faces.emplace_back(shape.loop(f).begin(), shape.loop(f).end());
  if (!(shape.rounding > 0.0)) return surface;
  std::vector<Vec<3>> points;
  for (const Vec<3>& vertex : shape.is_round() ? std::vector{Vec<3>(Vec<3>::Zero())} : shape.vertices)
    for (const Vec<3>& direction : directions()) points.emplace_back(vertex + shape.rounding * direction);
  return convex_hull<3>(points, "shape").polytope;
}

}  // namespace floc
