#include "floc/structure/voronoi_faces.h"

#include <algorithm>
#include <cmath>
#include <voro++/voro++.hh>

#include "floc/packing/contact_order.h"
#include "floc/structure/turned_cell.h"

namespace floc {
namespace {

/// A face of the Voronoi cell of a point, in the coordinates of Voro++ with this point as the origin.
struct Polygon {
  Vec<3> area = Vec<3>::Zero();    // area times the normal of the face
  Vec<3> centre = Vec<3>::Zero();  // centre of area of the face
};

Vec<3> corner(const std::vector<double>& vertices, int v) {
  return {vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]};
}

/// Returns the area and the centre of a face, by splitting it into triangles that share the first corner.
Polygon polygon_of(const std::vector<double>& vertices, const int* corners, int n) {
  Polygon out;
  double total = 0.0;
  const Vec<3> first = corner(vertices, corners[0]);
  for (int k = 1; k + 1 < n; ++k) {
    const Vec<3> a = corner(vertices, corners[k]), b = corner(vertices, corners[k + 1]);
    const Vec<3> area = 0.5 * (a - first).cross(b - first);
    out.area += area;
    out.centre += area.norm() * (first + a + b) / 3.0;
    total += area.norm();
  }
  if (total > 0.0) out.centre /= total;
  return out;
}

class FaceList {
 public:
  FaceList(const Cell<3>& cell, const std::vector<Vec<3>>& points, const TurnedCell& turned, VoronoiFaces& out)
      : cell_(cell), points_(points), turned_(turned), out_(out) {}

  void add(int i, voro::voronoicell_neighbor& of_point) {
    out_.volume[i] = of_point.volume() * std::pow(turned_.unit, 3);
    of_point.vertices(vertices_);
    of_point.neighbors(neighbours_);
    of_point.face_vertices(corners_);
    std::size_t at = 0;
    for (const int j : neighbours_) {
      const int n = corners_[at++];
      if (j >= i) add_face(i, j, polygon_of(vertices_, &corners_[at], n));
      at += n;
    }
  }

 private:
  void add_face(int i, int j, const Polygon& face) {
    const double area = face.area.norm();
    if (!(area > kNoFace)) return;
    // The face is the perpendicular bisector of the branch between the two points.
    const Vec<3> normal = face.area / area;
    const Vec<3> branch = turned_.here(2.0 * normal.dot(face.centre) * normal);
    const Vec<3> cells = cell_.reduced(branch - (points_[j] - points_[i]));
    VoronoiFace out;
    out.i = i, out.j = j;
    out.image = cells.array().round().cast<int>().matrix();
    if (i == j && !is_canonical(out)) return;
    out.branch = points_[j] + cell_.shift(out.image) - points_[i];
    out.centre = turned_.here(face.centre);
    out.area = area * turned_.unit * turned_.unit;
    out_.faces.push_back(out);
  }

  /// Faces with areas up to this value are due to rounding; in the exact tessellation, they are edges or corners. The
  /// unit of length is such that the mean volume of a Voronoi cell is 1.
  static constexpr double kNoFace = 1e-12;

  const Cell<3>& cell_;
  const std::vector<Vec<3>>& points_;
  const TurnedCell& turned_;
  VoronoiFaces& out_;
  std::vector<double> vertices_;
  std::vector<int> neighbours_, corners_;
};

}  // namespace

VoronoiFaces voronoi_faces(const Cell<3>& cell, const std::vector<Vec<3>>& points) {
  VoronoiFaces out;
  out.volume.assign(points.size(), 0.0);
  const TurnedCell turned(cell, static_cast<int>(points.size()));
  const Mat<3>& l = turned.lattice;
  voro::container_periodic container(l(0, 0), l(1, 0), l(1, 1), l(2, 0), l(2, 1), l(2, 2), turned.blocks(0),
                                     turned.blocks(1), turned.blocks(2), TurnedCell::kMemoryPerBlock);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec<3> x = turned.there(points[i]);
    container.put(static_cast<int>(i), x[0], x[1], x[2]);
  }
  FaceList faces(cell, points, turned, out);
  voro::c_loop_all_periodic loop(container);
  voro::voronoicell_neighbor of_point;
  if (loop.start()) do {
      if (container.compute_cell(of_point, loop)) faces.add(loop.pid(), of_point);
    } while (loop.inc());
  std::sort(out.faces.begin(), out.faces.end(), precedes<VoronoiFace>);
  return out;
}

}  // namespace floc
