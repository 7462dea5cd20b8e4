#include "floc/rigid/separating_planes.h"

#include <algorithm>
#include <limits>

#include "floc/geometry/frame.h"
#include "floc/network/contact_network.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/wall_forces.h"
#include "floc/rigid/contact_points.h"
#include "floc/rigid/gap_curvature.h"

namespace floc {
namespace {

/// Positions in the list of unknowns of a pair and its plane. The list begins with the displacement of the first body.
/// The constants are the positions at which the other parts begin.
constexpr int kTurnOfFirst = 3, kSecond = 6, kTurnOfSecond = 9, kStretch = 12, kPlane = kPairUnknowns;

/// Calls visit(k, gradient, vertex, is_second, frame) for the gap of each vertex of a pair. With the normal n and the
/// offset d of the plane, a vertex x of the first body has the gap d - n.x, and a vertex x of the second body has the
/// gap n.x - d. The columns of `frame` are the normal and the two directions in which the normal turns.
template <class Visitor>
void for_each_gap(const GrainVertices& vertices, const SeparatingPlane& plane, const Visitor& visit) {
  const Mat<3> frame = contact_frame(plane.normal);
  const Vec<3> n = frame.col(0);
  std::size_t k = 0;
  for (const bool is_second : {false, true}) {
    if (is_second && plane.is_wall) break;
    const double sign = is_second ? 1.0 : -1.0;
    for (const Vec<3>& arm : vertices.of(is_second ? plane.j : plane.i)) {
      PlaneVector g = PlaneVector::Zero();
      g.segment<3>(is_second ? kTurnOfSecond : kTurnOfFirst) = sign * cross<double>(arm, n);
      if (is_second || plane.is_wall) {
        g.head<3>() = -n;
        g.segment<3>(kSecond) = n;
      }
      if (is_second) g.segment<3>(kStretch) = n.cwiseProduct(plane.branch);
      if (!plane.is_wall) {
        const Vec<3> from_centre = (is_second ? Vec<3>(plane.branch + arm) : arm) - plane.centre;
        g[kPlane] = sign * frame.col(1).dot(from_centre);
        g[kPlane + 1] = sign * frame.col(2).dot(from_centre);
        g[kPlane + 2] = -sign;
      }
      visit(k++, g, arm, is_second, frame);
    }
  }
}

std::array<int, kPairUnknowns> unknowns_of_pair(const Packing<3>& packing, const Contact<3>& c,
                                                const PlaneUnknowns& unknowns) {
  std::array<int, kPairUnknowns> out;
  out.fill(-1);
  for (int a = 0; a < 6; ++a) out[a] = PlaneUnknowns::of_grain(c.i) + a;
  if (packing.is_wall(c.j)) {
    out[kSecond + packing.wall(c.j).axis] = unknowns.wall[c.j - packing.grains.size()];
  } else {
    for (int a = 0; a < 6; ++a) out[kSecond + a] = PlaneUnknowns::of_grain(c.j) + a;
    for (int a = 0; a < 3; ++a) out[kStretch + a] = unknowns.stretch[a];
  }
  return out;
}

/// Returns a new separating plane for a pair with the given contact points.
SeparatingPlane new_plane(const Packing<3>& packing, const GrainVertices& vertices,
                          const PlaneUnknowns& unknowns, std::span<const Contact<3>> points) {
  const Contact<3>& c = points.front();
  SeparatingPlane plane;
  plane.i = c.i;
  plane.j = c.j;
  plane.image = c.image;
  plane.is_wall = packing.is_wall(c.j);
  plane.branch = branch(packing, c);
  plane.normal = c.normal;
  plane.unknown = unknowns_of_pair(packing, c, unknowns);
  plane.centre.setZero();
  for (const Contact<3>& p : points) plane.centre += p.arm_i / static_cast<double>(points.size());
  plane.offset = 0.0;
  if (!plane.is_wall) {
    double top = -std::numeric_limits<double>::infinity(), bottom = -top;
    for (const Vec<3>& v : vertices.of(c.i)) top = std::max(top, c.normal.dot(v));
    for (const Vec<3>& v : vertices.of(c.j)) bottom = std::min(bottom, c.normal.dot(plane.branch + v));
    plane.offset = 0.5 * (top + vertices.rounding(c.i) + bottom - vertices.rounding(c.j));
  }
  set_gaps(vertices, plane);
  return plane;
}

/// Returns the change of a gap when both grains grow, divided by their relative growth: minus the distance from the
/// centre of the grain to the surface above the vertex.
double change_by_growth(const SeparatingPlane& plane, std::size_t k, bool is_second) {
  const double between = plane.normal.dot(plane.branch);
  const double to_plane = plane.is_wall ? between : is_second ? between - plane.offset : plane.offset;
  return plane.gap[k] - to_plane;
}

}  // namespace

PlaneUnknowns::PlaneUnknowns(const Packing<3>& packing, const BoundaryLoad<3>& load)
    : n(of_grain(packing.grains.size())) {
  for (const Wall<3>& w : packing.walls) wall.push_back(follows_forces(w) ? n++ : -1);
  for (int a = 0; a < 3; ++a)
    if (load.under_stress[a] && !between_walls(packing.walls, a)) stretch[a] = n++;
}

double SeparatingPlane::force(std::size_t n_first) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < n_first; ++k) sum += multiplier[k];
  return sum;
}

GrainVertices::GrainVertices(const Grains<3>& grains) {
  for (int i = 0; i < grains.size(); ++i) {
    const PlacedShape<3> grain = grains.placed(i);
    for (int v = 0; v < std::max(1, grain.shape->n_vertices()); ++v)
      vertex_.push_back(grain.rotation * (grain.scale * core_vertex<3>(*grain.shape, v)));
    first_.push_back(static_cast<int>(vertex_.size()));
    rounding_.push_back(grain.rounding());
  }
}

bool GrainVertices::are_rounded() const {
  return std::ranges::any_of(rounding_, [](double rounding) { return rounding > 0.0; });
}

void set_gaps(const GrainVertices& vertices, SeparatingPlane& plane) {
  plane.gap.clear();
  const double distance = plane.is_wall ? plane.normal.dot(plane.branch) : plane.offset;
  for (const Vec<3>& arm : vertices.of(plane.i))
    plane.gap.push_back(distance - plane.normal.dot(arm) - vertices.rounding(plane.i));
  if (plane.is_wall) return;
  for (const Vec<3>& arm : vertices.of(plane.j))
    plane.gap.push_back(plane.normal.dot(plane.branch + arm) - distance - vertices.rounding(plane.j));
}

const SeparatingPlane* plane_of(const Contact<3>& contact, const std::vector<SeparatingPlane>& planes) {
  const auto pair_of = [](const auto& of) { return NeighborPair<3>{of.i, of.j, of.image}; };
  const NeighborPair<3> pair = pair_of(contact);
  const auto found = std::ranges::lower_bound(planes, pair, precedes<NeighborPair<3>>, pair_of);
  return found != planes.end() && same_pair(pair_of(*found), pair) ? &*found : nullptr;
}

std::vector<SeparatingPlane> separating_planes(const Packing<3>& packing, const GrainVertices& vertices,
                                               const PlaneUnknowns& unknowns, double reach,
                                               const std::vector<SeparatingPlane>& known) {
  const std::vector<Contact<3>> near = ContactPoints<3>().find(packing, 2.0 * reach);
  std::vector<SeparatingPlane> out;
  for (std::size_t first = 0, last; first < near.size(); first = last) {
    for (last = first; last < near.size() && same_pair(near[last], near[first]);) ++last;
    const std::span points = std::span(near).subspan(first, last - first);
    if (const SeparatingPlane* plane = plane_of(near[first], known))
      out.push_back(*plane);
    else if (std::ranges::min(points, {}, &Contact<3>::gap).gap < reach)
      out.push_back(new_plane(packing, vertices, unknowns, points));
  }
  return out;
}

SeparatingPlane moved_plane(const SeparatingPlane& plane, const Eigen::VectorXd& motion, const PlaneVector& own,
                            double share, const GrainVertices& vertices) {
  SeparatingPlane out = plane;
  const auto of = [&](int at) { return plane.unknown[at] >= 0 ? share * motion[plane.unknown[at]] : 0.0; };
  for (int a = 0; a < 3; ++a) out.branch[a] += of(kStretch + a) * plane.branch[a] + of(kSecond + a) - of(a);
  if (!plane.is_wall) {
    const Mat<3> frame = contact_frame(plane.normal);
    const double at_centre = plane.offset - plane.normal.dot(plane.centre) + share * own[kPlane + 2];
    const Vec<3> turned = frame.col(0) + share * (own[kPlane] * frame.col(1) + own[kPlane + 1] * frame.col(2));
    const double length = turned.norm();
    out.normal = turned / length;
    out.offset = at_centre / length + out.normal.dot(plane.centre);
  }
  set_gaps(vertices, out);
  return out;
}

void add_gaps(const GrainVertices& vertices, const SeparatingPlane& plane, const GapTerms& terms,
              PlaneMatrix& matrix, PlaneVector& load) {
  for_each_gap(
      vertices, plane,
      [&](std::size_t k, const PlaneVector& g, const Vec<3>& arm, bool is_second, const Mat<3>& frame) {
        const double l = plane.multiplier[k];
        const double sign = is_second ? 1.0 : -1.0;
        const double rounding = vertices.rounding(is_second ? plane.j : plane.i);
        load += (terms.mu - l * terms.growth * change_by_growth(plane, k, is_second)) / plane.gap[k] * g;
        matrix.noalias() += (l / plane.gap[k]) * g * g.transpose();
        const double bent = l * l / (l + terms.weak);
        const int turn = is_second ? kTurnOfSecond : kTurnOfFirst;
        matrix.block<3, 3>(turn, turn) -= bent * sign * turn_curvature(arm, Vec<3>(frame.col(0)));
        if (plane.is_wall) return;
        for (int t = 0; t < 2; ++t) {
          PlaneVector cross_terms = PlaneVector::Zero();
          const Vec<3> e = frame.col(1 + t);
          cross_terms.segment<3>(turn) = sign * cross<double>(arm, e);
          if (is_second) {
            cross_terms.head<3>() = -e;
            cross_terms.segment<3>(kSecond) = e;
            cross_terms.segment<3>(kStretch) = e.cwiseProduct(plane.branch);
          }
          matrix.col(kPlane + t) -= bent * cross_terms;
          matrix.row(kPlane + t) -= bent * cross_terms.transpose();
          matrix(kPlane + t, kPlane + t) += l * (plane.gap[k] + rounding);
        }
      });
}

std::vector<double> gap_changes(const GrainVertices& vertices, const SeparatingPlane& plane,
                                const PlaneVector& step, double growth) {
  std::vector<double> out;
  for_each_gap(vertices, plane,
               [&](std::size_t k, const PlaneVector& g, const Vec<3>&, bool is_second, const Mat<3>&) {
                 out.push_back(g.dot(step) + growth * change_by_growth(plane, k, is_second));
               });
  return out;
}

}  // namespace floc
