#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "floc/picture/drawn_scale.h"
#include "floc/picture/packing_picture.h"
#include "floc/picture/view.h"

namespace floc {

// Points are in the coordinates of a Camera: to the right, upwards, towards the eye (length).

struct SeenSphere {
  Vec<3> centre = Vec<3>::Zero();
  double radius = 0.0;  ///< drawn radius
  int grain = 0;
};

enum class TubeEnd {
  round,      ///< about the centre of a sphere narrower than the tube
  at_sphere,  ///< where the tube leaves a sphere
  cut,        ///< at a face of the cell or at a wall
};

/// A contact between the surfaces of its spheres as drawn.
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

/// An edge of a parallelepiped.
struct SeenEdge {
  Vec<3> from = Vec<3>::Zero();
  Vec<3> to = Vec<3>::Zero();
  int axis = 0;
  bool behind = false;   ///< whether both faces that meet in it face away from the eye
  bool outline = false;  ///< whether exactly one of these faces does
  std::vector<std::pair<double, double>> visible;  ///< parts that no sphere hides, as fractions of its length
};

/// Visible parts of a packing of spheres, in the order in which they are drawn.
struct SeenPacking {
  enum class Part { sphere, tube, arrow };
  struct Mark {
    Part part;
    int index;
    double depth;  ///< coordinate towards the eye of a sphere's centre, or of the middle of a tube or an arrow
  };

  std::vector<SeenSphere> spheres;
  std::vector<SeenTube> tubes;
  std::vector<SeenArrow> arrows;
  /// Parts from the farthest to the nearest. For spheres that do not overlap, the order of their centres is
  /// exact: in parallel projection, a plane separates the two, with the sphere of the nearer centre in front of
  /// it.
  std::vector<Mark> order;
  double far = 0.0, near = 0.0;      ///< least and largest depth of the spheres
  std::vector<SeenEdge> cell_edges;  ///< twelve
  std::vector<SeenEdge> slab_edges;  ///< twelve, or none without a slab
};

/// Returns the drawn radius of a sphere over its own radius.
double sphere_size(const PackingPicture<3>& picture, const View& view);

/// Returns the spheres of the cell, each once where its centre is, and the contacts, cut at the faces of the
/// cell. Spheres that are hidden completely are left out.
/// @param scale  for the widths of tubes and the lengths of arrows
SeenPacking seen_packing(const PackingPicture<3>& picture, const View& view, const DrawnScale& scale);

/// Returns the part of a segment that a sphere hides or contains, as fractions of its length within [0, 1];
/// nothing if there is none.
std::optional<std::pair<double, double>> hidden_part(const Vec<3>& from, const Vec<3>& to,
                                                     const SeenSphere& sphere);

/// Returns the edges of the part of a cell between two corners in reduced coordinates, each visible over all
/// its length.
std::vector<SeenEdge> edges_of(const Cell<3>& cell, const Camera& camera, const Vec<3>& low,
                               const Vec<3>& high);

}  // namespace floc
