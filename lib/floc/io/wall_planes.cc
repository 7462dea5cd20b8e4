#include "floc/io/wall_planes.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/io/wall_script.h"
#include "floc/shape/mesh_files.h"

namespace floc {
namespace {

/// A triangle counts as perpendicular to an axis if its extent along this axis, divided by its largest extent along any
/// axis, is at most this number. The number is not zero because binary STL files have seven digits.
constexpr double kFlatTriangle = 1e-5;

/// Whether the centre of at least one grain is directly above or below a plane, along the axis normal to the plane. The
/// result is true for an infinite plane.
bool faces_grains(const WallPlane& plane, const std::vector<ListedGrain>& grains, int n_axes) {
  if (!plane.corners) return true;
  const auto& [low, high] = *plane.corners;
  return std::any_of(grains.begin(), grains.end(), [&](const ListedGrain& g) {
    for (int a = 0; a < n_axes; ++a)
      if (a != plane.axis && (g.position[a] < low[a] || g.position[a] > high[a])) return false;
    return true;
  });
}

}  // namespace

std::vector<WallPlane> planes_of_mesh(const std::string& path, double scale, const Eigen::Vector3d& shift) {
  const Mesh<3> mesh = parse_stl(path, read_file(path));
  std::vector<WallPlane> planes;
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    WallPlane plane;
    plane.place = fmt::format("{}, triangle {}", path, t + 1);
    Eigen::Vector3d low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d corner = scale * mesh.vertices[static_cast<std::size_t>(mesh.faces[t][k])] + shift;
      low = k == 0 ? corner : low.cwiseMin(corner);
      high = k == 0 ? corner : high.cwiseMax(corner);
    }
    const double thickness = (high - low).minCoeff(&plane.axis);
    if (thickness > kFlatTriangle * (high - low).maxCoeff())
      throw InputError(
          plane.place,
          "the triangle is not perpendicular to an axis, expected planes perpendicular to x, y or z; to give "
          "the positions of walls without the file, write them after --walls, for example --walls z=0:");
    plane.position = 0.5 * (low[plane.axis] + high[plane.axis]);
    plane.corners = {low, high};
    planes.push_back(plane);
  }
  return planes;
}

ListedWalls read_wall_file(const std::string& path) {
  std::string end = path.substr(path.size() - std::min<std::size_t>(path.size(), 4));
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  if (end == ".stl") return {planes_of_mesh(path), std::nullopt, {}};
  return walls_of_script(path);
}

std::vector<ListedEnds> ends_of_planes(const std::vector<WallPlane>& planes,
                                       const std::vector<ListedGrain>& grains, int n_axes) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const ListedGrain& g : grains) centre += g.position / static_cast<double>(grains.size());
  ListedSpace space;
  for (const WallPlane& plane : planes) {
    if (plane.axis >= n_axes || !faces_grains(plane, grains, n_axes)) continue;
    const int side = plane.side.value_or(plane.position < centre[plane.axis] ? -1 : 1);
    ListedEnds& ends = ends_along(plane.axis, space);
    std::optional<double>& end = side < 0 ? ends.low : ends.high;
    if (!end || side * (*end - plane.position) > 0.0) end = plane.position;
  }
  return space.ends;
}

}  // namespace floc
