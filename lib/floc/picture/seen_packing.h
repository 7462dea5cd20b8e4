#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "floc/picture/drawn_scale.h"
#include "floc/picture/packing_picture.h"
#include "floc/picture/seen_body.h"
#include "floc/picture/view.h"

namespace floc {

// In the following structures, points are in the coordinates of a Camera: x to the right, y upwards, z towards the eye
// (length).

struct SeenSphere {
  Vec<3> centre = Vec<3>::Zero();
  double radius = 0.0;  ///< radius with which the sphere is drawn (length)
  int grain = 0;
};

enum class TubeEnd {
  round,      ///< a round end at a bend, or at the centre of a grain that is narrower than the tube
  at_sphere,  ///< an end at the surface of a grain
  cut,        ///< a flat end at a face of the cell or at a wall
};

/// A tube that shows a contact, from the surface of one grain to the surface of the other. If the line of the contact
/// bends at the contact point, there is one tube on each side of this point.
struct SeenTube {
  Vec<3> from = Vec<3>::Zero();
  Vec<3> to = Vec<3>::Zero();
  TubeEnd from_end = TubeEnd::round, to_end = TubeEnd::round;
  double width = 0.0;
  LineKind kind = LineKind::compression;
};

struct SeenArrow {
  Vec<3> from = Vec<3>::Zero();
  Vec<3> to = Vec<3>::Zero();
};

/// An edge of the cell, or of a slab of the cell. Both the cell and the slab are parallelepipeds.
struct SeenEdge {
  Vec<3> from = Vec<3>::Zero();
  Vec<3> to = Vec<3>::Zero();
  int axis = 0;
  bool behind = false;   ///< whether both adjacent faces of the edge face away from the eye
  bool outline = false;  ///< whether exactly one adjacent face of the edge faces away from the eye
  /// Parts that no grain hides, as fractions of the length of the edge.
  std::vector<std::pair<double, double>> visible;
};

/// Visible parts of a packing in 3D, with the order in which they are drawn.
struct SeenPacking {
  enum class Part { sphere, body, tube, arrow };
  struct Mark {
    Part part;
    int index;
    /// Coordinate towards the eye (length) of the centre of a grain, or of the middle of a tube or arrow. If a grain
    /// has to be drawn after grains with a larger coordinate, its depth is raised to the largest depth of these grains.
    double depth;
  };

  std::vector<SeenSphere> spheres;
  std::vector<SeenBody> bodies;  ///< grains that are not spheres
  std::vector<SeenTube> tubes;
  std::vector<SeenArrow> arrows;
  /// Parts in the order from the farthest to the nearest. Spheres are in the order of their centres. This order is
  /// exact for spheres that do not overlap: a plane separates two such spheres, and in parallel projection the sphere
  /// with the nearer centre is in front of the plane. Grains with corners are in the order of drawing_order().
  std::vector<Mark> order;
  double far = 0.0, near = 0.0;      ///< smallest and largest coordinate of grain centres towards the eye
  std::vector<SeenEdge> cell_edges;  ///< the twelve edges of the cell
  std::vector<SeenEdge> slab_edges;  ///< the twelve edges of the slab; empty without a slab
};

/// Returns the drawn radius of a sphere divided by its true radius.
double sphere_size(const PackingPicture<3>& picture, const View& view);

/// Returns the visible parts of a packing. Each grain appears once, as the periodic copy with its centre in the cell.
/// Contacts are cut at the faces of the cell. Grains that are completely hidden are left out.
/// @param scale  scale of the widths of tubes and the lengths of arrows
SeenPacking seen_packing(const PackingPicture<3>& picture, const View& view, const DrawnScale& scale);

/// Returns the part of a line segment that a sphere hides or contains: its two ends, as fractions of the length of the
/// segment in [0, 1]. Absent if the whole segment is visible.
std::optional<std::pair<double, double>> hidden_part(const Vec<3>& from, const Vec<3>& to,
                                                     const SeenSphere& sphere);

/// Returns the twelve edges of a part of a cell. This part is a parallelepiped given by two opposite corners. The list
/// of visible parts of each edge is still empty.
/// @param low,high  reduced coordinates of the two corners
std::vector<SeenEdge> edges_of(const Cell<3>& cell, const Camera& camera, const Vec<3>& low,
                               const Vec<3>& high);

}  // namespace floc
