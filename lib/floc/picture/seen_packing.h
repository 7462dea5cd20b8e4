#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "floc/picture/drawn_scale.h"
#include "floc/picture/packing_picture.h"
#include "floc/picture/view.h"

namespace floc {

// Points are as a Camera sees them: to the right, upwards, towards the eye (length).

struct SeenSphere {
  Vec<3> centre = Vec<3>::Zero();
  double radius = 0.0;  ///< as drawn
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
  bool behind = false;                             ///< both faces that meet in it look away from the eye
  bool outline = false;                            ///< one of them does
  std::vector<std::pair<double, double>> visible;  ///< what no sphere hides, as fractions of its length
};

/// What is to be drawn of a packing of spheres, and in which order.
struct SeenPacking {
  enum class Part { sphere, tube, arrow };
  struct Mark {
    Part part;
    int index;
    double depth;  ///< towards the eye: of a sphere's centre, of the middle of a tube or an arrow
  };

  std::vector<SeenSphere> spheres;
  std::vector<SeenTube> tubes;
  std::vector<SeenArrow> arrows;
  /// From the farthest to the nearest. For spheres that do not overlap the order of their centres is exact: in
  /// parallel projection the plane that touches both leaves the nearer centre's sphere in front.
  std::vector<Mark> order;
  double far = 0.0, near = 0.0;      ///< least and largest depth of the spheres
  std::vector<SeenEdge> cell_edges;  ///< twelve
  std::vector<SeenEdge> slab_edges;  ///< twelve, or none without a slab
};

/// Drawn radius of a sphere over its own.
double sphere_size(const PackingPicture<3>& picture, const View& view);

/// The spheres of the cell, each once where its centre is, and the contacts, cut at the faces of the cell.
/// Spheres of which nothing is to be seen are left out.
/// @param scale  for the widths of tubes and the lengths of arrows
SeenPacking seen_packing(const PackingPicture<3>& picture, const View& view, const DrawnScale& scale);

/// The part of a segment that a sphere hides or contains, as fractions of its length: cut to [0, 1], or
/// nothing.
std::optional<std::pair<double, double>> hidden_part(const Vec<3>& from, const Vec<3>& to,
                                                     const SeenSphere& sphere);

/// Edges of the part of a cell between two corners in reduced coordinates; nothing hides them yet.
std::vector<SeenEdge> edges_of(const Cell<3>& cell, const Camera& camera, const Vec<3>& low,
                               const Vec<3>& high);

}  // namespace floc
