#include "floc/shape/read_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/range.h"
#include "floc/base/read_file.h"
#include "floc/shape/moments.h"

namespace floc {
namespace {

/// A surface that encloses less than this fraction of the volume of its convex hull counts as not convex.
constexpr double kConvexShare = 1.0 - 1e-6;

/// Requires that the faces of a mesh form a closed surface.
void require_closed(const std::string& place, const Mesh<3>& mesh) {
  // For each pair of vertices (from, to), the number of faces in whose list of vertices `to` follows directly after
  // `from`.
  std::map<std::pair<int, int>, int> along;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<int>& face = mesh.faces[f];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int from = face[k], to = face[(k + 1) % face.size()];
      if (from == to)
        throw InputError(place, fmt::format("face {} has vertex {} twice: expected each vertex of a face once",
                                            f + 1, from + 1));
      ++along[{from, to}];
    }
  }
  for (const auto& [ends, n] : along) {
    const auto back = along.find({ends.second, ends.first});
    const int n_back = back == along.end() ? 0 : back->second;
    if (n + n_back != 2)
      throw InputError(
          place,
          fmt::format("the edge between vertices {} and {} has {} faces: expected a closed surface, with "
                      "two faces at each edge",
                      ends.first + 1, ends.second + 1, n + n_back));
    if (mesh.is_oriented && n != 1)
      throw InputError(
          place,
          fmt::format(
              "two faces have vertex {} before vertex {}: expected the corners of all faces in one sense of "
              "rotation, as seen from outside",
              ends.first + 1, ends.second + 1));
  }
}
void require_closed(const std::string&, const Mesh<2>&) {}

/// Returns the vertices of a mesh that belong to any face; all vertices if the mesh has no faces.
template <int Dim>
std::vector<Vec<Dim>> used_vertices(const Mesh<Dim>& mesh) {
  if (mesh.faces.empty()) return mesh.vertices;
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const std::vector<int>& face : mesh.faces)
    for (const int i : face) is_used[i] = true;
  std::vector<Vec<Dim>> used;
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (is_used[i]) used.push_back(mesh.vertices[i]);
  return used;
}

/// If all chosen points lie in one plane, replaces the last of them by the point furthest from the plane. The furthest
/// corners of a cuboid, for example, are those of a rectangle.
/// @param points  vertices of a convex polyhedron  @param chosen  more than three of them
void leave_one_plane(const std::vector<Vec<3>>& points, std::vector<Vec<3>>& chosen) {
  constexpr double kThin = 1e-6;  // thickness, divided by the size, below which points count as coplanar
  const Vec<3> along = chosen[1] - chosen[0];
  // The normal is that of the largest triangle at the first two points, which are far from each other.
  Vec<3> normal = Vec<3>::Zero();
  for (const Vec<3>& p : chosen)
    if (const Vec<3> across = along.cross(p - chosen[0]); across.norm() > normal.norm()) normal = across;
  normal.normalize();
  const auto height = [&](const Vec<3>& p) { return std::abs(normal.dot(p - chosen[0])); };
  const auto lower = [&](const Vec<3>& a, const Vec<3>& b) { return height(a) < height(b); };
  if (height(*std::ranges::max_element(chosen, lower)) > kThin * along.norm()) return;
  const Vec<3> furthest = *std::ranges::max_element(points, lower);
  chosen.back() = furthest;
}

/// Chooses n of the given points that are far from each other. The first chosen point is furthest from the mean of all
/// points. Each next chosen point has the largest distance from the nearest of the points chosen before.
template <int Dim>
std::vector<Vec<Dim>> spread_points(const std::vector<Vec<Dim>>& points, int n) {
  Vec<Dim> mean = Vec<Dim>::Zero();
  for (const Vec<Dim>& p : points) mean += p / static_cast<double>(points.size());
  std::vector<double> distance;
  for (const Vec<Dim>& p : points) distance.push_back((p - mean).squaredNorm());
  std::vector<Vec<Dim>> chosen;
  for (int k = 0; k < n && k < static_cast<int>(points.size()); ++k) {
    const Vec<Dim>& next = points[std::max_element(distance.begin(), distance.end()) - distance.begin()];
    chosen.push_back(next);
    for (std::size_t i = 0; i < points.size(); ++i)
      distance[i] =
          k == 0 ? (points[i] - next).squaredNorm() : std::min(distance[i], (points[i] - next).squaredNorm());
  }
  if constexpr (Dim == 3) leave_one_plane(points, chosen);
  return chosen;
}

/// Returns the volume enclosed by a surface. The origin is first moved to a vertex of the surface, so that no digits
/// are lost if the surface is far from the origin.
template <int Dim>
double volume_of(Polytope<Dim> surface) {
  const Vec<Dim> origin = surface.vertices[0];
  for (Vec<Dim>& v : surface.vertices) v -= origin;
  return sharp_moments(surface).volume;
}

/// Returns the shape of a mesh with one or two vertices and a radius of rounding: a sphere or a capsule.
template <int Dim>
Shape<Dim> shape_of_few(const std::string& place, const Mesh<Dim>& mesh) {
  if (mesh.vertices.size() == 1) return round_shape<Dim>(mesh.rounding);
  return capsule_between<Dim>(mesh.vertices[0], mesh.vertices[1], mesh.rounding, place);
}

std::string ending(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  std::string found = dot == std::string::npos ? "" : path.substr(dot);
  std::transform(found.begin(), found.end(), found.begin(), [](unsigned char c) { return std::tolower(c); });
  return found;
}

template <int Dim>
std::vector<Mesh<Dim>> meshes_of(const std::string& path, std::string_view content);

template <>
std::vector<Mesh<2>> meshes_of(const std::string& path, std::string_view content) {
  if (ending(path) != ".csv")
    throw InputError(
        path, "the name of the file does not end in .csv: expected a .csv file with the corners of a polygon");
  return {parse_points<2>(path, content)};
}

template <>
std::vector<Mesh<3>> meshes_of(const std::string& path, std::string_view content) {
  const std::string format = ending(path);
  if (format == ".off") return {parse_off(path, content)};
  if (format == ".obj") return {parse_obj(path, content)};
  if (format == ".stl") return {parse_stl(path, content)};
  if (format == ".csv") return {parse_points<3>(path, content)};
  if (format == ".shp") return parse_rockable(path, content);
  throw InputError(path,
                   "the ending of the name of the file is unknown: expected a name that ends in .off, .obj, "
                   ".stl, .csv or .shp");
}

}  // namespace

template <int Dim>
NamedShape<Dim> shape_of_mesh(const std::string& place, const Mesh<Dim>& mesh,
                              const ShapeFileOptions& options) {
  if (options.vertices != 0)
    require_in_range("vertices", std::int64_t{options.vertices}, {.least = Dim + 1, .most = kMostVertices});
  if (options.rounding > 0.0 && mesh.rounding > 0.0)
    throw InputError(
        place,
        fmt::format(
            "rounding = {:g}: the file already gives a radius of rounding for this shape; leave out rounding",
            options.rounding));
  // One or two points have no convex hull with a volume. If the file gives a radius of rounding, the points
  // nevertheless define a sphere or a capsule.
  if (mesh.rounding > 0.0 && mesh.vertices.size() <= 2) return {mesh.name, shape_of_few(place, mesh), {}};

  const std::vector<Vec<Dim>> points = used_vertices(mesh);
  NamedShape<Dim> made{mesh.name, {}, {}};
  ConvexHull<Dim> hull = convex_hull<Dim>(points, place);
  require_distinct<Dim>(points, place);
  if (!mesh.faces.empty()) require_closed(place, mesh);
  const std::size_t n_left_out = points.size() - hull.points.size();
  if (n_left_out > 0)
    made.remarks.push_back(
        fmt::format("{} of {} points are not vertices of the convex hull, which is used as the shape",
                    n_left_out, points.size()));
  const double whole = volume_of(hull.polytope);
  if (!mesh.faces.empty() && mesh.is_oriented) {
    // Even if every point is a vertex of the hull, the surface between the points may have dents. The number of points
    // left out is therefore no test of convexity, but the volume is: only a convex surface encloses the whole volume of
    // its hull. The sum over the faces is the enclosed volume if all faces have one sense of rotation, and its sign
    // depends on this sense.
    const double enclosed = std::abs(volume_of(Polytope<Dim>{mesh.vertices, mesh.faces}));
    if (enclosed < kConvexShare * whole)
      made.remarks.push_back(
          fmt::format("the surface is not convex: it encloses {:.4g} of the volume of its convex hull; the "
                      "hull is used as the shape",
                      enclosed / whole));
  }
  const std::size_t n_before = hull.polytope.vertices.size();
  // The points to keep are chosen from the vertices of the hull. All points of the mesh would be the wrong set, because
  // a chosen point inside the hull may not be a vertex of the shape.
  if (options.vertices != 0 && static_cast<int>(n_before) > options.vertices) {
    hull = convex_hull<Dim>(spread_points<Dim>(hull.polytope.vertices, options.vertices), place);
    made.remarks.push_back(fmt::format(
        "{} of {} vertices of the convex hull are kept; the hull of these vertices has {:.4g} of the volume of "
        "the full hull",
        hull.points.size(), n_before, volume_of(hull.polytope) / whole));
  }
  made.shape = mesh.rounding > 0.0 ? polytope_shape<Dim>(hull.polytope, mesh.rounding, place)
                                   : with_rounding_share<Dim>(hull.polytope, options.rounding, place);
  return made;
}

template <int Dim>
std::vector<NamedShape<Dim>> parse_shapes(const std::string& path, std::string_view content,
                                          const ShapeFileOptions& options) {
  std::vector<NamedShape<Dim>> shapes;
  const std::vector<Mesh<Dim>> meshes = meshes_of<Dim>(path, content);
  for (const Mesh<Dim>& mesh : meshes) {
    const std::string place = meshes.size() > 1 ? fmt::format("{}, shape \"{}\"", path, mesh.name) : path;
    shapes.push_back(shape_of_mesh<Dim>(place, mesh, options));
  }
  return shapes;
}

template <int Dim>
std::vector<NamedShape<Dim>> read_shapes(const std::string& path, const ShapeFileOptions& options) {
  return parse_shapes<Dim>(path, read_file(path), options);
}

template NamedShape<2> shape_of_mesh(const std::string&, const Mesh<2>&, const ShapeFileOptions&);
template NamedShape<3> shape_of_mesh(const std::string&, const Mesh<3>&, const ShapeFileOptions&);
template std::vector<NamedShape<2>> parse_shapes(const std::string&, std::string_view, const ShapeFileOptions&);
template std::vector<NamedShape<3>> parse_shapes(const std::string&, std::string_view, const ShapeFileOptions&);
template std::vector<NamedShape<2>> read_shapes(const std::string&, const ShapeFileOptions&);
template std::vector<NamedShape<3>> read_shapes(const std::string&, const ShapeFileOptions&);

}  // namespace floc
