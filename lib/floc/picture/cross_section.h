#pragma once

#include <string>
#include <vector>

#include "floc/picture/packing_picture.h"

namespace floc {

/// A plane across a cell in 3D, parallel to two of the cell vectors.
struct CrossSection {
  int axis = 1;     ///< index of the cell vector that crosses the plane, counted from 0
  double at = 0.5;  ///< position of the plane, as a fraction of this cell vector

  /// Axes of the packing to the right and upwards in pictures: y and z for a plane across x, x and z across y, x and y
  /// across z.
  int right() const { return axis == 0 ? 1 : 0; }
  int up() const { return axis == 2 ? 1 : 2; }

  /// Returns all errors of the plane, as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Returns a picture in 2D of the section of a packing by a plane. It has the sections of all grains, and of their
/// periodic copies, that the plane crosses, in the colours of the grains. Contacts and displacements are left out.
///
/// The sections of spheres and of sharp polyhedra are exact. The section of a rounded polyhedron or of a capsule is a
/// polygon of kSectionCorners corners, which lie on its outline. In the picture, the cell vector right() lies along the
/// first axis.
PackingPicture<2> cross_section(const PackingPicture<3>& picture, const CrossSection& plane);

/// Number of corners of the polygon that shows the section of a rounded polyhedron or of a capsule.
inline constexpr int kSectionCorners = 128;

/// Returns the outline of the section of a shape by the plane of the first two axes; empty if the plane does not cross
/// the shape. Coordinates are those on the first two axes.
Outline section_outline(const PlacedShape<3>& placed);

}  // namespace floc
