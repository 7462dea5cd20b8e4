#include "floc/io/rockable_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/read_text.h"
#include "floc/shape/read_shapes.h"

namespace floc {
namespace {

/// Differences between the volume in the file and that of the convex shape, divided by the latter: above the first, a
/// remark tells the user, above the second, the file contradicts itself. Rockable estimates volumes from random points,
/// and volumes of its rounded polyhedra are known to be too small by 8 percent.
constexpr double kSameVolume = 0.01, kOtherVolume = 0.1;
/// Largest accepted difference between moments of inertia per mass, divided by that of the convex shape. Rockable finds
/// them by random points, so that they have larger errors than volumes.
constexpr double kSameInertia = 0.05;
/// Largest accepted distance of the centre of mass from the origin of the vertices, divided by the radius of the shape.
constexpr double kCentred = 1e-3;

/// Compares the volume, the moments of inertia and the centre of mass in the file with those of the convex shape.
void add_contradictions(const std::string& place, const Mesh<3>& mesh, const Shape<3>& shape,
                        ListedPacking& listed) {
  const double share = mesh.volume > 0.0 ? std::abs(mesh.volume / shape.volume - 1.0) : 0.0;
  if (share > kSameVolume)
    (share > kOtherVolume ? listed.inconsistencies : listed.remarks)
        .push_back(fmt::format(
            "{}: the volume is {:.6g} in the file, but the convex shape has {:.6g}: masses follow from the "
            "volume in the file, the solid fraction from the convex shape",
            place, mesh.volume, shape.volume));
  // The axes of the file may be in another order.
  Vec<3> given = mesh.inertia_over_mass, own = shape.inertia / shape.volume;
  std::ranges::sort(given);
  std::ranges::sort(own);
  if (!given.isZero(0.0) && (given - own).cwiseAbs().maxCoeff() > kSameInertia * own.maxCoeff())
    listed.inconsistencies.push_back(fmt::format(
        "{}: the moments of inertia over the mass (I/m) are {:.4g}, {:.4g} and {:.4g} in the file, but "
        "the convex shape has {:.4g}, {:.4g} and {:.4g}, which are used",
        place, given[0], given[1], given[2], own[0], own[1], own[2]));
  const double off = shape.centre.norm();
  if (off > kCentred * shape.outer_radius)
    listed.inconsistencies.push_back(fmt::format(
        "{}: the centre of mass of the convex shape is {:.3g} away from the origin of the vertices, "
        "{:.2g} of the radius of the shape, although the file says \"preCompDone y\": floc uses the "
        "centre of the convex shape, about which moments may be out of balance",
        place, off, off / shape.outer_radius));
}

Shape<3> make_shape(const std::string& path, const Mesh<3>& mesh, ListedPacking& listed) {
  const std::string place = fmt::format("{}, shape \"{}\"", path, mesh.name);
  if (is_sphere(mesh)) {
    Shape<3> ball = round_shape<3>(mesh.rounding);
    add_contradictions(place, mesh, ball, listed);
    return ball;
  }
  if (!mesh.is_principal)
    throw InputError(
        place,
        "the shape has no line \"preCompDone y\": expected vertices in coordinates about the centre of "
        "mass and along the principal axes of inertia, as Rockable computes them");
  NamedShape<3> made = shape_of_mesh<3>(place, mesh, {});
  for (const std::string& remark : made.remarks) listed.remarks.push_back(place + ": " + remark);
  add_contradictions(place, mesh, made.shape, listed);
  return std::move(made.shape);
}

}  // namespace

bool is_sphere(const Mesh<3>& shape) {
  return shape.vertices.size() == 1 && shape.vertices.front().isZero(0.0);
}

RockableShapes::RockableShapes(const std::string& path) : path_(path) {
  for (Mesh<3>& mesh : parse_rockable(path, read_text(path))) {
    const std::string name = mesh.name;
    meshes_.emplace(name, std::move(mesh));
  }
}

const Mesh<3>& RockableShapes::mesh(const FileLine& place, const std::string& name) const {
  const auto found = meshes_.find(name);
  if (found != meshes_.end()) return found->second;
  throw InputError(place.text(), fmt::format("the shape {} is not in the file of shapes, {}", name, path_));
}

int RockableShapes::index(const FileLine& place, const std::string& name, ListedPacking& listed) {
  const auto [at, is_new] = indices_.try_emplace(name, static_cast<int>(listed.shapes.in_3d.size()));
  if (is_new) listed.shapes.in_3d.push_back(make_shape(path_, mesh(place, name), listed));
  return at->second;
}

}  // namespace floc
