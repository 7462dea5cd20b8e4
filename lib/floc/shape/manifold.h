#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "floc/shape/placed_shape.h"
#include "floc/shape/separating_axis.h"

namespace floc {

/// Kinds of contact, by the number of points in reach. In 2D two sides that face each other are kFaceFace.
enum class ContactType : std::uint8_t {
  kVertexFace,  ///< one point, other than that of two edges
  kEdgeEdge,    ///< one point of two edges that cross
  kDouble,      ///< two points in 3D: an edge on a face
  kFaceFace     ///< three points or more; two in 2D
};

/// "vertex-face", "edge-edge", "double", "face-face"
std::string contact_type_name(ContactType type);

/// One point of a contact.
template <int Dim>
struct ManifoldPoint {
  /// From the centre of the first shape to the point midway between the surfaces, in the axes of space.
  Vec<Dim> arm = Vec<Dim>::Zero();
  double gap = 0.0;  ///< between the surfaces along the normal; negative where they overlap
  /// Number that the point keeps while the features that meet in it stay. Bits from the highest: body of the
  /// reference face (1), reference feature (10), incident feature (10), side that begins at the corner (10;
  /// 1023 for closest points), edge pair (1). Keys of one contact differ.
  std::uint32_t key = 0;
};

/// Where two shapes touch or may touch.
template <int Dim>
struct Manifold {
  static constexpr int kMostPoints = Dim == 2 ? 2 : 4;

  int n = 0;                           ///< number of points; 0 if no gap is below the reach
  Vec<Dim> normal = Vec<Dim>::Zero();  ///< from the first shape to the second
  ContactType type = ContactType::kVertexFace;
  std::array<ManifoldPoint<Dim>, kMostPoints> points;

  double least_gap() const;
};

/// Contact of two shapes: points with a gap below `reach`.
///
/// Cores that are polytopes meet along the axis of the largest separation (separating_axis.h). A face axis
/// gives the corners of the incident face clipped by the sides of the reference face, in 3D at most four of
/// them: the deepest, the furthest from it, and those furthest to either side of the line through both. An edge
/// pair gives one point. Shapes with rounding, whose cores are apart, meet in their closest points, but along a
/// face whose normal is within 1e-3 of theirs as faces do.
///
/// Gaps are those of the axis of largest separation but for the margins of separating_axis(): 1e-4 of the
/// smaller inner radius for edges, 1e-6 for faces. Exchange of the shapes turns the normal round and keeps gaps
/// and points but for such ties.
///
/// @param reach  length >= 0
/// @param last   features of the step before, to begin with, replaced by those found: they reject most pairs
///               that do not touch at the cost of one support.
template <int Dim>
Manifold<Dim> contact_manifold(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second, double reach,
                               AxisFeatures* last = nullptr);

}  // namespace floc
