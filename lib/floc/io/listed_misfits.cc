#include "floc/io/listed_misfits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/locate.h"
#include "floc/shape/placed_shape.h"

namespace floc {
namespace {

/// A contact point does not fit the shapes if its misfit exceeds this fraction of the diameter of the smaller body. The
/// fraction is larger than the overlaps of soft grains, because the points of a pair of faces that are not parallel
/// differ by the overlap.
constexpr double kLargestMisfit = 0.03;

/// Returns the largest distance (length), along a unit vector, from the centre of a grain to a point of the grain.
template <int Dim>
double reach(const PlacedShape<Dim>& grain, const Vec<Dim>& direction) {
  return grain.scale * extent<Dim>(*grain.shape, grain.rotation.transpose() * direction);
}

/// Returns the misfit (length) of a contact point: the largest of
///   1. the distance by which the surface of a body lies outside the interval of length |gap| about the plane through
///      the point across the normal, because the point may lie on either surface or between them
///   2. the difference between the gap and the distance of the surfaces along the normal.
template <int Dim>
double misfit(const Packing<Dim>& packing, const Contact<Dim>& c) {
  // Heights of the surfaces beyond the plane; the sum of both is the overlap along the normal.
  const double first = reach(packing.grains.placed(c.i), c.normal) - c.normal.dot(c.arm_i);
  const double second = packing.is_wall(c.j)
                            ? packing.wall(c.j).normal().dot(c.arm_j)
                            : reach(packing.grains.placed(c.j), Vec<Dim>(-c.normal)) + c.normal.dot(c.arm_j);
  const double off =
      std::max(std::abs(first + 0.5 * c.gap), std::abs(second + 0.5 * c.gap)) - 0.5 * std::abs(c.gap);
  return std::max(off, std::abs(first + second + c.gap));
}

/// Returns the names of the bodies of a listed contact, for messages.
std::string bodies_of(const ListedContact& row) {
  if (row.wall) return fmt::format("grain {} and the wall {}", row.id1, row.wall->name());
  return fmt::format("grains {} and {}", row.id1, row.id2);
}

}  // namespace

template <int Dim>
void PointMisfits::add(const ListedContact& row, const Packing<Dim>& packing, const Contact<Dim>& contact) {
  // The centres of two convex bodies lie on both sides of the contact plane.
  const Vec<Dim> to_second =
      packing.is_wall(contact.j) ? packing.wall(contact.j).normal() : Vec<Dim>(branch(packing, contact));
  if (row.normal && contact.normal.dot(to_second) < 0.0)
    throw InputError(
        row.place.text(),
        fmt::format("the normal of the contact of {} is reversed: along it, each of the two bodies "
                    "lies on the side of the other; expected the opposite direction",
                    bodies_of(row)));
  ++n_points_;
  const double share = misfit(packing, contact) / (2.0 * smaller_radius(packing, contact));
  if (share <= kLargestMisfit) return;
  const std::string where = fmt::format("{}, {}", row.place.text(), bodies_of(row));
  if (n_misfits_++ == 0) first_ = where;
  if (share > largest_) largest_ = share, worst_ = where;
}

std::string PointMisfits::sentence() const {
  if (n_misfits_ == 0) return "";
  return fmt::format(
      "{} of {} contact points do not fit the shapes (first at {}): a surface lies up to {:.2g} diameters of "
      "the smaller grain away from the point{}, so that a position, an orientation, a shape, or the point, "
      "normal or gap of a contact is wrong",
      n_misfits_, n_points_, first_, largest_, worst_ == first_ ? "" : fmt::format(" ({})", worst_));
}

template void PointMisfits::add(const ListedContact&, const Packing<2>&, const Contact<2>&);
template void PointMisfits::add(const ListedContact&, const Packing<3>&, const Contact<3>&);

}  // namespace floc
