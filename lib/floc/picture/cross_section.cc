#include "floc/picture/cross_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace floc {
namespace {

using Edge = std::pair<Vec<3>, Vec<3>>;

/// Returns the edges of the core of a placed shape. The core of a capsule, a segment, is its only edge.
std::vector<Edge> edges_of_core(const PlacedShape<3>& placed) {
  const auto vertex = [&placed](int v) {
    return Vec<3>(placed.position + placed.scale * (placed.rotation * placed.shape->vertices[v]));
  };
  if (placed.shape->n_faces() == 0) return {{vertex(0), vertex(1)}};
  std::vector<Edge> edges;
  for (const ShapeEdge& edge : placed.shape->edges) edges.emplace_back(vertex(edge.from), vertex(edge.to));
  return edges;
}

/// Returns the points where edges cross the plane z = 0, in counter-clockwise order around their mean. These are the
/// corners of the section of a polyhedron.
std::vector<Vec<2>> crossings(const std::vector<Edge>& edges) {
  std::vector<Vec<2>> points;
  Vec<2> mean = Vec<2>::Zero();
  for (const auto& [from, to] : edges) {
    if ((from[2] < 0.0) == (to[2] < 0.0)) continue;
    points.emplace_back((from + (to - from) * (from[2] / (from[2] - to[2]))).head<2>());
    mean += points.back();
  }
  mean /= std::max(1.0, static_cast<double>(points.size()));
  const auto angle = [&mean](const Vec<2>& x) { return std::atan2(x[1] - mean[1], x[0] - mean[0]); };
  std::ranges::sort(points, {}, angle);
  return points;
}

/// A ball around a point of an edge cuts a disk out of the plane z = 0. Of all these disks, the function finds the disk
/// that reaches furthest in a direction, and returns its outermost point in this direction.
///
/// The disk around the point x + t d of the edge, where z is its height, reaches as far as
/// (x + t d) . u + sqrt(r^2 - z^2). Where the edge rises, this is largest at the height z = r s/sqrt(1 + s^2) with
/// s = (d . u)/d_z, or at the end of the range of heights that is nearest to it.
/// @param u  unit vector in the plane
/// @return no value if no point of the edge is within `radius` of the plane
std::optional<Vec<2>> outermost(const Edge& edge, double radius, const Vec<2>& u) {
  auto [low, high] = edge;
  if (low[2] > high[2]) std::swap(low, high);
  const double lowest = std::max(low[2], -radius), highest = std::min(high[2], radius);
  if (lowest > highest) return std::nullopt;
  const Vec<3> along = high - low;
  const double rise = along[2], run = along.head<2>().dot(u);
  double z = lowest, t = run > 0.0 ? 1.0 : 0.0;
  if (rise > 0.0) {
    z = std::clamp(radius * run / std::hypot(run, rise), lowest, highest);
    t = std::clamp((z - low[2]) / rise, 0.0, 1.0);
  }
  return low.head<2>() + t * along.head<2>() + std::sqrt(std::max(0.0, radius * radius - z * z)) * u;
}

/// Returns points of the outline of the section of a rounded shape by the plane z = 0: for each of kSectionCorners
/// directions, the outermost point of the section.
std::vector<Vec<2>> rounded_section(const std::vector<Edge>& edges, double radius) {
  std::vector<Vec<2>> points;
  for (int k = 0; k < kSectionCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kSectionCorners;
    const Vec<2> u(std::cos(angle), std::sin(angle));
    std::optional<Vec<2>> furthest;
    for (const Edge& edge : edges) {
      const auto point = outermost(edge, radius, u);
      if (point && (!furthest || point->dot(u) > furthest->dot(u))) furthest = point;
    }
    if (!furthest) return {};
    points.push_back(*furthest);
  }
  return points;
}

Outline circle(const Vec<2>& centre, double radius) {
  return {{{centre, 0.0, 2.0 * std::numbers::pi}}, radius};
}

/// Coordinates in which the plane of a section is z = 0, with the cell vector to the right along the first axis.
class PlaneCoordinates {
 public:
  PlaneCoordinates(const Cell<3>& cell, const CrossSection& plane)
      : origin_(plane.at * cell.matrix.row(plane.axis).transpose()) {
    const Vec<3> right = cell.matrix.row(plane.right()), up = cell.matrix.row(plane.up());
    const Vec<3> u = right.normalized();
    const Vec<3> v = (up - up.dot(u) * u).normalized();
    axes_.row(0) = u, axes_.row(1) = v, axes_.row(2) = u.cross(v);
    cell_.matrix << right.dot(u), 0.0, up.dot(u), up.dot(v);
  }

  const Cell<2>& cell() const { return cell_; }
  const Mat<3>& axes() const { return axes_; }
  Vec<3> of(const Vec<3>& x) const { return axes_ * (x - origin_); }

 private:
  Vec<3> origin_;
  Mat<3> axes_;
  Cell<2> cell_;
};

}  // namespace

std::vector<std::string> CrossSection::validate() const {
  std::vector<std::string> faults;
  if (axis < 0 || axis > 2) faults.push_back(fmt::format("cut axis = {}: must be 0 to 2", axis));
  if (!(at >= 0.0 && at <= 1.0))
    faults.push_back(fmt::format(
        "cut = {}: must be 0 to 1 (position along the axis of the cut, as a fraction of the cell)", at));
  return faults;
}

Outline section_outline(const PlacedShape<3>& placed) {
  if (placed.shape->is_round()) {
    const double height = placed.position[2], radius = placed.rounding();
    if (std::abs(height) >= radius) return {};
    return circle(placed.position.head<2>(), std::sqrt(radius * radius - height * height));
  }
  const std::vector<Edge> edges = edges_of_core(placed);
  const double radius = placed.rounding();
  Outline outline;
  for (const Vec<2>& x : radius > 0.0 ? rounded_section(edges, radius) : crossings(edges))
    outline.corners.push_back({x, 0.0, 0.0});
  return outline;
}

PackingPicture<2> cross_section(const PackingPicture<3>& picture, const CrossSection& plane) {
  PackingPicture<2> section;
  const PlaneCoordinates coordinates(picture.cell, plane);
  section.cell = coordinates.cell();
  section.caption = picture.caption;
  section.note = picture.note;
  section.shade.largest = picture.shade.largest;
  section.shade.name = picture.shade.name;
  const Vec<3> period = coordinates.axes() * picture.cell.matrix.row(plane.axis).transpose();
  for (int i = 0; i < static_cast<int>(picture.position.size()); ++i) {
    const Shape<3> ball = round_shape<3>(picture.radius[i]);
    const DrawnShape<3> grain = picture.is_round(i) ? DrawnShape<3>{&ball} : picture.shape[i];
    const Vec<3> centre = coordinates.of(picture.cell.wrapped(picture.position[i]));
    // Copies along the vector across the plane; the drawing adds the copies along the other two.
    const double reach = picture.radius[i] / std::abs(period[2]), height = centre[2] / period[2];
    for (int k = static_cast<int>(std::ceil(-height - reach)); k <= std::floor(-height + reach); ++k) {
      PlacedShape<3> copy = grain.at(centre + k * period);
      copy.rotation = coordinates.axes() * copy.rotation;
      Outline outline = section_outline(copy);
      if (outline.corners.empty()) continue;
      section.outline.push_back(std::move(outline));
      section.position.emplace_back(copy.position.head<2>());
      section.radius.push_back(picture.radius[i]);
      if (!picture.rattler.empty()) section.rattler.push_back(picture.rattler[i]);
      if (!picture.shade.value.empty()) section.shade.value.push_back(picture.shade.value[i]);
    }
  }
  return section;
}

}  // namespace floc
