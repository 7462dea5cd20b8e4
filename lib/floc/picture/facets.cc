#include "floc/picture/facets.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace floc {
namespace {

/// Makes the facets of a rounded polyhedron. The points are the corners of the faces of the core, each moved outwards
/// along the normal of its face. The points are numbered like `Shape::corners`.
class BevelledFacets {
 public:
  explicit BevelledFacets(const Shape<3>& shape) : shape_(shape) {}

  Facets all() {
    for (int f = 0; f < shape_.n_faces(); ++f) add_face(f);
    for (const ShapeEdge& edge : shape_.edges) add_edge(edge);
    for (int v = 0; v < shape_.n_vertices(); ++v) add_vertex(v);
    return std::move(facets_);
  }

 private:
  void add_face(int face) {
    Facets::Facet facet{{}, shape_.normals[face]};
    for (const int v : shape_.loop(face)) {
      facet.corners.push_back(static_cast<int>(facets_.points.size()));
      facets_.points.push_back(shape_.vertices[v] + shape_.rounding * shape_.normals[face]);
    }
    facets_.facets.push_back(std::move(facet));
  }

  void add_edge(const ShapeEdge& edge) {
    facets_.facets.push_back({{corner(edge.left, edge.to), corner(edge.left, edge.from),
                               corner(edge.right, edge.from), corner(edge.right, edge.to)},
                              (shape_.normals[edge.left] + shape_.normals[edge.right]).normalized()});
  }

  void add_vertex(int vertex) {
    Vec<3> out = Vec<3>::Zero();
    for (const int f : shape_.faces_at(vertex)) out += shape_.normals[f];
    out.normalize();
    const Vec<3> a = out.unitOrthogonal(), b = out.cross(a);
    std::vector<std::pair<double, int>> around;  // corners around the outward direction: angle and index
    for (const int f : shape_.faces_at(vertex)) {
      const Vec<3>& n = shape_.normals[f];
      around.emplace_back(std::atan2(n.dot(b), n.dot(a)), corner(f, vertex));
    }
    std::sort(around.begin(), around.end());
    Facets::Facet facet{{}, out};
    for (const auto& [angle, corner] : around) facet.corners.push_back(corner);
    facets_.facets.push_back(std::move(facet));
  }

  /// Returns the index of the point at a vertex of a face. @pre the vertex belongs to the face
  int corner(int face, int vertex) const {
    const auto loop = shape_.loop(face);
    return shape_.first_corner[face] +
           static_cast<int>(std::find(loop.begin(), loop.end(), vertex) - loop.begin());
  }

  const Shape<3>& shape_;
  Facets facets_;
};

}  // namespace

Facets facets_of(const Shape<3>& shape) {
  if (shape.rounding > 0.0) return BevelledFacets(shape).all();
  Facets facets;
  facets.points = shape.vertices;
  for (int f = 0; f < shape.n_faces(); ++f) {
    const auto loop = shape.loop(f);
    facets.facets.push_back({{loop.begin(), loop.end()}, shape.normals[f]});
  }
  return facets;
}

}  // namespace floc
