#include "floc/io/listed_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "floc/base/error.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/locate.h"
#include "floc/shape/closest_points.h"

namespace floc {
namespace {

/// Largest accepted distance of a contact point from the circumscribed circle or sphere of a grain, if the point is
/// outside, divided by the radius of this circle or sphere. This number is large because a file may have few digits,
/// and because the point may lie on the surface of the other grain.
constexpr double kFarthestPoint = 0.1;
/// Smallest key of a listed contact point that corresponds to no contact point of the two shapes.
constexpr int kFirstFreeKey = kMostFaces << 21;
/// A contact point of floc and a contact point of another program count as the same point if their distance is at most
/// this fraction of the smaller radius.
constexpr double kOnePointShare = 0.25;

/// Largest accepted difference of the length of a listed normal from 1. Components with four digits after the point
/// change it by less.
constexpr double kUnitLength = 1e-3;
/// A contact point lies at an image of a grain if its distance from the surface of the image is at most the first
/// number, and at this image alone if the distance from any other is larger by the second number. Both are divided by
/// the radius of the grain.
constexpr double kNearSurface = 0.1, kNearer = 0.05;

/// Subtracts lattice vectors from a vector, so that its reduced coordinates along the periodic axes are at most 1/2 in
/// magnitude.
template <int Dim>
Vec<Dim> nearest_of_images(const Packing<Dim>& packing, const Vec<Dim>& vector) {
  Vec<Dim> cells = packing.cell.reduced(vector);
  for (int a = 0; a < Dim; ++a) cells[a] = between_walls(packing.walls, a) ? 0.0 : std::round(cells[a]);
  return vector - packing.cell.matrix.transpose() * cells;
}

/// Returns the type of a contact of which only the point is known, as far as a single point tells it.
template <int Dim>
ContactType type_at_point(const Packing<Dim>& packing, const Contact<Dim>& c) {
  if (Dim == 2) return ContactType::kVertexFace;
  const double reach = kOnePointShare * smaller_radius(packing, c);
  const bool crosses = manifold_of(packing, c, branch(packing, c), reach).type == ContactType::kEdgeEdge;
  return crosses ? ContactType::kEdgeEdge : ContactType::kVertexFace;
}

/// Returns all images with the numbers -1, 0 and 1 along the periodic axes.
template <int Dim>
std::vector<Vec<Dim, int>> images_beside(const Packing<Dim>& packing) {
  std::vector<Vec<Dim, int>> images = {Vec<Dim, int>::Zero()};
  for (int a = 0; a < Dim; ++a) {
    if (between_walls(packing.walls, a)) continue;
    const std::size_t n = images.size();
    for (const int step : {-1, 1})
      for (std::size_t k = 0; k < n; ++k) {
        images.push_back(images[k]);
        images.back()[a] = step;
      }
  }
  return images;
}

/// Returns the distance (length) of a point from the surface of a grain.
/// @param arm  vector from the centre of the grain to the point
template <int Dim>
double distance_to_surface(const Packing<Dim>& packing, int grain, const Vec<Dim>& arm) {
  const Grains<Dim>& grains = packing.grains;
  if (grains.are_round()) return std::abs(arm.norm() - grains.radius[grain]);
  PlacedShape<Dim> body = grains.placed(grain);
  body.position.setZero();
  const Shape<Dim> point = round_shape<Dim>(0.0);
  const RelativePlace<Dim> place(body, PlacedShape<Dim>{&point, body.scale, arm, Mat<Dim>::Identity()});
  const ClosestPoints<Dim> at = closest_points(*body.shape, point, place, Vec<Dim>(place.offset));
  if (!at.overlap) return std::abs(body.scale * at.distance - body.rounding());
  // The point is inside the core, the shape without its rounding.
  double depth = body.shape->n_faces() > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  for (int f = 0; f < body.shape->n_faces(); ++f)
    depth = std::min(depth, body.shape->offsets[f] - body.shape->normals[f].dot(place.offset));
  return body.scale * std::max(depth, 0.0) + body.rounding();
}

/// A grain, or a periodic image of it, at whose surface a contact point lies.
template <int Dim>
struct GrainAtPoint {
  int grain = 0;
  Vec<Dim> offset = Vec<Dim>::Zero();  ///< vector from the centre of the first grain of the contact
};

/// Returns the arm of a contact point: the vector from the centre of the first grain to the periodic image of the point
/// that lies at the surfaces of all `grains`. Grains that are longer than half the cell can be near several images of
/// the point. The listed place is kept if no image of it fits clearly better.
/// @param listed  vector from the centre of the first grain to the listed point
template <int Dim>
Vec<Dim> arm_at_surfaces(const Packing<Dim>& packing, std::span<const GrainAtPoint<Dim>> grains,
                         const Vec<Dim>& listed) {
  const std::vector<double>& radius = packing.grains.radius;
  const auto is_within_reach = [&](const Vec<Dim>& arm) {
    return std::ranges::all_of(grains, [&](const GrainAtPoint<Dim>& at) {
      return (arm - at.offset).norm() <= (1.0 + kNearSurface) * radius[at.grain];
    });
  };
  const auto misfit = [&](const Vec<Dim>& arm) {
    double largest = 0.0;
    for (const GrainAtPoint<Dim>& at : grains)
      largest =
          std::max(largest, distance_to_surface<Dim>(packing, at.grain, arm - at.offset) / radius[at.grain]);
    return largest;
  };
  const Vec<Dim> nearest = nearest_of_images(packing, listed);
  std::vector<Vec<Dim>> arms;
  for (const Vec<Dim, int>& image : images_beside(packing)) {
    arms.push_back(nearest + packing.cell.shift(image));
    if (!is_within_reach(arms.back())) arms.pop_back();
  }
  if (arms.empty()) return nearest;
  if (arms.size() == 1) return arms.front();
  const Vec<Dim> best = *std::ranges::min_element(arms, {}, misfit);
  return is_within_reach(listed) && misfit(listed) <= misfit(best) + kNearer ? listed : best;
}

template <int Dim>
void require_near(const ListedContact& row, double distance, double radius, const char* body) {
  if (distance <= (1.0 + kFarthestPoint) * radius) return;
  throw InputError(
      row.place.text(),
      fmt::format("the contact point is {:.6g} away from the centre of the {} grain, whose furthest "
                  "corner is {:.6g} away: the point, a position or the cell is wrong",
                  distance, body, radius));
}

bool is_of_several(ContactType type) {
  return type == ContactType::kDouble || type == ContactType::kFaceFace;
}

/// Returns the type of the contact points of a pair. A listed type of several points is kept, as some of the points may
/// carry no force and not be listed. Otherwise several points have the type that follows from their number.
template <int Dim>
ContactType type_of(std::size_t n_points, ContactType listed) {
  if (n_points == 1 || is_of_several(listed)) return listed;
  if (Dim == 2 || n_points > 2) return ContactType::kFaceFace;
  return ContactType::kDouble;
}

/// Sets the keys of the contact points of one pair. A listed point that is near a contact point of the two shapes gets
/// the key of this contact point. Any other listed point gets a free number as its key. Sorts the points by key.
template <int Dim>
void number_pair(const Packing<Dim>& packing, std::span<Contact<Dim>> points) {
  const double radius = smaller_radius(packing, points.front());
  const Manifold<Dim> manifold =
      manifold_of(packing, points.front(), branch(packing, points.front()), kOnePointShare * radius);
  std::set<int> taken;
  int next = kFirstFreeKey;
  // A kind of several points that any row lists holds for the pair.
  const ContactType most = std::ranges::max_element(points, {}, &Contact<Dim>::type)->type;
  const ContactType listed = is_of_several(most) ? most : points.front().type;
  for (Contact<Dim>& c : points) {
    c.type = type_of<Dim>(points.size(), listed);
    const ManifoldPoint<Dim>* nearest = manifold.nearest(c.arm_i);
    const bool same = nearest && (nearest->arm - c.arm_i).norm() <= kOnePointShare * radius;
    c.key = same ? static_cast<int>(nearest->key) : next;
    while (!taken.insert(c.key).second) c.key = next++;
  }
  std::ranges::sort(points, precedes<Contact<Dim>>);
}

}  // namespace

Eigen::Vector3d unit_normal(const FileLine& place, const Eigen::Vector3d& listed) {
  const double length = listed.norm();
  if (std::abs(length - 1.0) <= kUnitLength) return listed / length;
  throw InputError(place.text(), fmt::format("the normal of the contact has the length {:.6g}, expected a unit "
                                             "vector (length 1 to within {:g})",
                                             length, kUnitLength));
}

template <int Dim>
std::optional<Vec<Dim, int>> image_at_point(const ListedContact& row, const Packing<Dim>& packing,
                                            const Contact<Dim>& contact) {
  const std::vector<Vec<Dim>>& x = packing.grains.position;
  const double radius = packing.grains.radius[contact.j];
  const GrainAtPoint<Dim> first = {.grain = contact.i};
  const Vec<Dim> arm =
      arm_at_surfaces<Dim>(packing, std::span(&first, 1), row.point->template head<Dim>() - x[contact.i]);
  std::optional<Vec<Dim, int>> nearest;
  double least = std::numeric_limits<double>::infinity(), next = least;
  for (const Vec<Dim, int>& beside : images_beside<Dim>(packing)) {
    const Vec<Dim, int> image = contact.image + beside;
    if (contact.i == contact.j && image.isZero()) continue;
    const Vec<Dim> arm_j = arm - (x[contact.j] + packing.cell.shift(image) - x[contact.i]);
    // A point outside the circumscribed circle or sphere is not near the surface.
    if (arm_j.norm() > (1.0 + kNearSurface + kNearer) * radius) continue;
    const double distance = distance_to_surface(packing, contact.j, arm_j);
    next = std::min(next, std::max(distance, least));
    if (distance < least) least = distance, nearest = image;
  }
  if (least > kNearSurface * radius || next - least < kNearer * radius) return std::nullopt;
  return nearest;
}

template <int Dim>
void place_point(const ListedContact& row, bool reversed, const Packing<Dim>& packing, Contact<Dim>& c) {
  if (!row.point)
    throw InputError(row.place.text(), fmt::format("the contact has no contact point: expected the columns "
                                                   "point1, point2{} for contacts of grains with corners",
                                                   Dim == 3 ? ", point3" : ""));
  const Vec<Dim> to_second = branch(packing, c);
  // The listed point may lie near any periodic image of grain i. The arm of j follows from the branch vector, because a
  // second search for an image of the point could find a point on another image of j.
  std::vector<GrainAtPoint<Dim>> grains = {{.grain = c.i}};
  if (!packing.is_wall(c.j)) grains.push_back({.grain = c.j, .offset = to_second});
  c.arm_i =
      arm_at_surfaces<Dim>(packing, grains, row.point->template head<Dim>() - packing.grains.position[c.i]);
  c.arm_j = c.arm_i - to_second;
  require_near<Dim>(row, c.arm_i.norm(), packing.grains.radius[c.i], reversed ? "second" : "first");
  if (!packing.is_wall(c.j))
    require_near<Dim>(row, c.arm_j.norm(), packing.grains.radius[c.j], reversed ? "first" : "second");
  if (!row.normal || !row.gap) {
    // locate() prefers the contact point with the key of the contact to the nearest one. The contact has no key yet, so
    // it gets one that no contact point of two shapes has.
    c.key = kFirstFreeKey;
    const ContactGeometry<Dim> at = locate(packing, c);
    c.normal = at.normal;
    c.gap = at.gap;
  }
  // The listed normal points from id1 to id2, but c.normal points from c.i to c.j.
  if (row.normal)
    c.normal = (reversed ? -1.0 : 1.0) * unit_normal(row.place, *row.normal).template head<Dim>().normalized();
  if (row.gap) c.gap = *row.gap;
  c.type = row.kind ? *row.kind : type_at_point(packing, c);
  if (!is_contact_type_in(c.type, Dim))
    throw InputError(
        row.place.text(),
        fmt::format("the kind of the contact is {}, expected {} or {} in 2D", contact_type_name(c.type),
                    contact_type_name(ContactType::kVertexFace), contact_type_name(ContactType::kFaceFace)));
}

template <int Dim>
void number_points(const Packing<Dim>& packing, std::vector<Contact<Dim>>& contacts) {
  for (std::size_t first = 0, last; first < contacts.size(); first = last) {
    last = first;
    while (last < contacts.size() && same_pair(contacts[first], contacts[last])) ++last;
    number_pair(packing, std::span(contacts).subspan(first, last - first));
  }
}

#define FLOC_INSTANTIATE(Dim)                                                                     \
  template std::optional<Vec<Dim, int>> image_at_point(const ListedContact&, const Packing<Dim>&, \
                                                       const Contact<Dim>&);                      \
  template void place_point(const ListedContact&, bool, const Packing<Dim>&, Contact<Dim>&);      \
  template void number_points(const Packing<Dim>&, std::vector<Contact<Dim>>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
