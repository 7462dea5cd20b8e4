#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floc/base/vec.h"
#include "floc/geometry/cell.h"
#include "floc/packing/packing.h"
#include "floc/picture/outline.h"

namespace floc {

/// Meaning of a line between two grains. Lines are drawn in the order of these kinds: a later kind covers an earlier
/// kind.
enum class LineKind {
  background,  ///< a contact that the picture shows, but does not emphasize
  zero,        ///< a contact whose normal force is zero within the tolerance
  distant,
  tension,
  compression,
  lost,
  gained,
};

/// An interaction of two grains (or of a grain and a wall), drawn as a line from the centre of grain i to the centre of
/// grain j. Between shapes with corners, the line bends at the contact point.
template <int Dim>
struct ContactLine {
  Vec<Dim> from = Vec<Dim>::Zero();
  Vec<Dim> to = Vec<Dim>::Zero();  ///< centre of the periodic image of grain j that interacts with grain i
  LineKind kind = LineKind::compression;
  double force = 0.0;  ///< force that the width of the line shows, in units of `PackingPicture::force_unit`
  int i = 0, j = 0;    ///< indices of the grains (or walls) at both ends
  /// Contact point at which the line bends; absent if the line is straight, as between round grains.
  std::optional<Vec<Dim>> through = std::nullopt;
};

/// Displacement of a grain, drawn as an arrow.
template <int Dim>
struct DisplacementArrow {
  Vec<Dim> from = Vec<Dim>::Zero();
  Vec<Dim> displacement = Vec<Dim>::Zero();
  int grain = 0;
};

/// Values of the grains, which are shown by their colours.
struct GrainShade {
  std::vector<double> value;  ///< value of each grain
  double largest = 1.0;       ///< value > 0 at the end of the colour scale; larger values have the same colour
  std::string name;           ///< name of the quantity in the legend
};

/// Shape of a grain in a picture, with size and orientation. The centre of the shape is the position of the grain.
template <int Dim>
struct DrawnShape {
  const Shape<Dim>* shape = nullptr;
  double scale = 1.0;                        ///< factor by which the shape is magnified
  Mat<Dim> rotation = Mat<Dim>::Identity();  ///< rotation from the axes of the shape to the axes of space

  /// Returns the shape with its centre at `centre`, magnified by another factor `size`.
  PlacedShape<Dim> at(const Vec<Dim>& centre, double size = 1.0) const {
    return {shape, size * scale, centre, rotation};
  }
};

/// A layer of a cell between two planes, which are parallel to two cell vectors. The positions of the planes, `from`
/// and `to`, are fractions of the third cell vector.
struct Slab {
  int axis = 2;  ///< index of the cell vector that crosses the layer, counted from 0
  double from = 0.0, to = 1.0;

  /// Returns all errors of the slab, as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// A picture of a packing: grains, lines, arrows and colours. Lengths are in the unit of length of the state. Each
/// grain, line and arrow is stored once. The functions that draw the picture add the periodic copies, and clip them at
/// the border of the cell.
template <int Dim>
struct PackingPicture {
  Cell<Dim> cell;
  std::vector<Vec<Dim>> position;
  std::vector<double> radius;
  /// Shape of each grain; empty if all grains are disks or spheres.
  std::vector<DrawnShape<Dim>> shape;
  /// 2D: outline of each grain in the section of a packing in 3D, see cross_section(). Empty in other pictures, where
  /// the outlines follow from `radius` and `shape`.
  std::vector<Outline> outline;
  /// Table of shapes to which `shape` points, shared with the packing.
  std::shared_ptr<const std::vector<Shape<Dim>>> shapes;
  std::vector<bool> rattler;  ///< whether each grain is a rattler; empty if no rattlers are marked
  std::vector<ContactLine<Dim>> lines;
  /// Symbol of the unit in which forces of lines are given, such as "F₀", for the legend.
  std::string force_unit;
  std::string force_symbol = "F";
  // Texts in the legend for kinds of lines.
  std::string compression_name = "compression";
  std::string tension_name = "tension";
  std::string distant_name = "distant";
  std::string background_name = "other contacts";
  std::vector<DisplacementArrow<Dim>> arrows;
  /// Layer of the cell that is shown, see part_in_slab(). If absent, the whole cell is shown.
  std::optional<Slab> slab;
  GrainShade shade;  ///< values that colour the grains; if there are none, grains are grey
  /// Parts of the caption above the picture. The caption is broken into lines between two parts; a part is broken only
  /// if it is wider than a line.
  std::vector<std::string> caption;
  std::string note;  ///< note in the legend; may be empty

  /// Whether grain i is a disk or a sphere.
  bool is_round(int i) const { return shape.empty() || shape[i].shape->is_round(); }
};

/// Returns a picture with only the cell and the grains of a packing, to which lines, arrows and colours can be added.
template <int Dim>
PackingPicture<Dim> grains_of(const Packing<Dim>& packing);

/// Returns the line that shows a contact of a packing. Between round grains, the line is the branch vector. If the
/// packing has grains with corners, the line goes from the centre of grain i to the contact point, and from there to
/// the centre of grain j unless j is a wall.
/// @param force  force in the unit of the picture
template <int Dim>
ContactLine<Dim> contact_line(const Packing<Dim>& packing, const Contact<Dim>& contact, LineKind kind,
                              double force);

/// Returns the part of a picture that lies in a slab of the cell: the grains with their centres in the slab, the arrows
/// of these grains, and the lines between two of these grains. A centre on the border between two slabs belongs to the
/// upper slab.
PackingPicture<3> part_in_slab(const PackingPicture<3>& picture, const Slab& slab);

}  // namespace floc
