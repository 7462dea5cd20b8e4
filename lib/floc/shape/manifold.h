#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "floc/shape/placed_shape.h"
#include "floc/shape/separating_axis.h"

namespace floc {

/// Types of contact of two shapes. They differ in the number of contact points. In 2D, a contact of two sides has the
/// type kFaceFace.
enum class ContactType : std::uint8_t {
  kVertexFace,  ///< one point that is not a crossing of two edges
  kEdgeEdge,    ///< one point at which two edges cross
  kDouble,      ///< two points in 3D: an edge on a face
  kFaceFace     ///< three points or more in 3D, two points in 2D
};

/// Returns the name of a contact type: "vertex-face", "edge-edge", "double" or "face-face".
std::string contact_type_name(ContactType type);
/// Returns the contact type with a name as contact_type_name() returns it; absent for any other text.
std::optional<ContactType> contact_type_of(std::string_view name);
/// Returns whether contacts of this type exist in a dimension, 2 or 3: in 2D only vertex-face and face-face.
bool is_contact_type_in(ContactType type, int dimension);

/// One contact point of two shapes.
template <int Dim>
struct ManifoldPoint {
  /// Vector from the centre of the first shape to the point midway between the surfaces (length), in space-fixed axes.
  Vec<Dim> arm = Vec<Dim>::Zero();
  double gap = 0.0;  ///< distance between the surfaces along the normal (length); negative if they overlap
  /// Number that identifies the contact point from step to step, as long as the same two features (faces or edges) meet
  /// at the point. The points of one contact have different keys. The fields of the number, from the highest bit, are:
  /// whether the reference face belongs to the second shape (1 bit); index of the reference feature (10 bits); index of
  /// the incident feature (10 bits); number of the side that begins at the corner, or 1023 for closest points (10
  /// bits); whether the features are two edges (1 bit).
  std::uint32_t key = 0;
};

/// Contact points of two shapes that touch or are close to each other.
template <int Dim>
struct Manifold {
  Vec<Dim> normal = Vec<Dim>::Zero();  ///< unit vector from the first shape to the second
  ContactType type = ContactType::kVertexFace;
  /// All points with a gap below `reach` of contact_manifold(). If a corner of two faces were left out because another
  /// corner is a little deeper, a rigid pair would turn to and fro between two sets of corners and never come to rest,
  /// and forces inside the polygon of all corners would have no balance.
  std::vector<ManifoldPoint<Dim>> points;

  int n() const { return static_cast<int>(points.size()); }
  /// Returns the smallest gap of the points (length); infinity if there are none.
  double least_gap() const;
  /// Returns the point with a key; null if there is none.
  const ManifoldPoint<Dim>* with_key(std::uint32_t key) const;
  /// Returns the point nearest to the end of an arm, a vector from the centre of the first shape (length); null if
  /// there are no points.
  const ManifoldPoint<Dim>* nearest(const Vec<Dim>& arm) const;
};

/// Options of contact_manifold().
struct ManifoldOptions {
  /// Whether normals have to be accurate to about 1e-6 instead of 1e-4 radians, and both ends of an edge on a face are
  /// needed. Grains in equilibrium without friction require this, because errors of the normals unbalance their forces.
  /// The features that define the contact then depend on differences of gaps of 1e-6 of the smaller inner radius.
  bool exact = false;
  /// Preference for faces over edge pairs if two shapes overlap. An edge pair defines the contact only if the overlap
  /// along the common normal of the edges is smaller than the overlap along the normal of a face by this share of the
  /// latter. If two nearly parallel faces overlap at a corner, these faces then define the contact. With a value of 0,
  /// a rigid pair can be pushed apart at another corner in each step and never come to rest. If the smallest gap above
  /// a face and the gap of an edge pair differ by less than 1e-6 of the smaller inner radius, the face is preferred,
  /// too.
  double face_preference = 0.0;
  /// Length by which the gap along the axis of other features must at least be larger, so that they replace the
  /// features of the step before. It takes effect where it exceeds the usual margins, which are shares of the inner
  /// radius.
  double least_margin = 0.0;
};

/// Returns the features that define the axis of a contact point, from its key; the kind is AxisKind::kNone if the key
/// is that of closest points, or if the shapes do not have these features.
template <int Dim>
AxisFeatures axis_features(std::uint32_t key, const Shape<Dim>& first, const Shape<Dim>& second);

/// Computes the contact of two shapes: the points with a gap smaller than `reach`.
///
/// There are four cases:
///   1. Polytopes without rounding touch along the axis of their largest separation (separating_axis.h). If this axis
///      is the normal of a face (the reference face), the contact points are the corners of the incident face of the
///      other shape, clipped by the sides of the reference face.
///   2. If the axis of the largest separation is the common normal of a pair of edges, there is one contact point.
///   3. If polytopes without rounding are apart, it can happen that no axis of separating_axis.h is parallel to the
///      line between their closest points (for example between two vertices). In this case there is one contact point,
///      midway between the closest points.
///   4. Rounded shapes whose cores (the shapes without rounding) do not overlap touch at their closest points. If the
///      line between these points is normal to a face to within 1e-3 radians, the contact is treated as a contact with
///      this face.
///
/// If the shapes are apart, the smallest gap is their distance. If they overlap, the smallest gap is minus the length
/// of the smallest translation that separates them. Both values are accurate up to the margins of separating_axis():
/// 1e-4 of the smaller inner radius for edges and 1e-6 for faces, or 1e-6 for both with ManifoldOptions::exact; with
/// ManifoldOptions::face_preference, overlaps can be larger. If the two shapes are exchanged, the normal is reversed;
/// gaps and points do not change, up to the margins.
///
/// @param reach  largest gap of a contact point (length), >= 0
/// @param last  features of the separating axis in the previous step, with which the search begins; the function
/// replaces them by the features found now. For most pairs that do not touch, the old features still separate the
/// shapes, and the search ends after a single search for a lowest vertex.
template <int Dim>
Manifold<Dim> contact_manifold(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second, double reach,
                               AxisFeatures* last = nullptr, const ManifoldOptions& options = {});

}  // namespace floc
