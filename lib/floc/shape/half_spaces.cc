#include "floc/shape/half_spaces.h"

#include "floc/base/error.h"
#include "floc/shape/convex_hull.h"
#include "floc/shape/moments.h"

namespace floc {

template <int Dim>
std::optional<std::vector<Vec<Dim>>> intersection_vertices(const std::vector<HalfSpace<Dim>>& half_spaces) {
  std::vector<Vec<Dim>> dual;
  for (const HalfSpace<Dim>& half : half_spaces) dual.push_back(half.normal / half.offset);
  Polytope<Dim> hull;
  try {
    hull = convex_hull<Dim>(dual).polytope;
  } catch (const InputError&) {
    // there are fewer than Dim + 1 normals, or the points normal/offset lie in one plane
    return std::nullopt;
  }
  double size = 0.0;
  for (const Vec<Dim>& y : hull.vertices) size = std::max(size, y.norm());
  std::vector<Vec<Dim>> vertices;
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const Vec<Dim> m = face_normal(hull, static_cast<int>(f)).normalized();
    double offset = 0.0;
    for (const int k : hull.faces[f])
      offset += m.dot(hull.vertices[k]) / static_cast<double>(hull.faces[f].size());
    if (!(offset > 1e-6 * size)) return std::nullopt;
    vertices.push_back(m / offset);
  }
  return vertices;
}

template std::optional<std::vector<Vec<2>>> intersection_vertices(const std::vector<HalfSpace<2>>&);
template std::optional<std::vector<Vec<3>>> intersection_vertices(const std::vector<HalfSpace<3>>&);

}  // namespace floc
