#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/base/vec.h"
#include "floc/geometry/cell.h"
#include "floc/packing/packing.h"

namespace floc {

/// Meaning of a line between two grains. Kinds are drawn in this order, the last on top.
enum class LineKind {
  background,  ///< a contact in the background: outside the set shown
  zero,        ///< no normal force within the tolerance
  distant,
  tension,
  compression,
  lost,
  gained,
};

/// A contact as a line between the centres of its grains.
template <int Dim>
struct ContactLine {
  Vec<Dim> from = Vec<Dim>::Zero();
  Vec<Dim> to = Vec<Dim>::Zero();  ///< centre of the image of the other grain
  LineKind kind = LineKind::compression;
  double force = 0.0;  ///< size of the force in `PackingPicture::force_unit`; the width is proportional to it
  int i = 0, j = 0;    ///< bodies at its start and at its end
};

/// Displacement of a grain.
template <int Dim>
struct DisplacementArrow {
  Vec<Dim> from = Vec<Dim>::Zero();
  Vec<Dim> displacement = Vec<Dim>::Zero();
  int grain = 0;
};

/// A value of every grain, shown as its colour.
struct GrainShade {
  std::vector<double> value;  ///< value of each grain
  double largest = 1.0;       ///< value of the last colour, > 0, which larger values have too
  std::string name;           ///< name of the value in the legend
};

/// A layer of a cell between two lattice planes, as fractions of a lattice vector.
struct Slab {
  int axis = 2;  ///< index of the lattice vector, from 0
  double from = 0.0, to = 1.0;

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// A packing to be drawn, in the unit of length of the state: grains, lines, arrows, colours. Nothing here is
/// cut or copied yet: the drawing repeats periodically and cuts at the border of the cell.
template <int Dim>
struct PackingPicture {
  Cell<Dim> cell;
  std::vector<Vec<Dim>> position;
  std::vector<double> radius;
  std::vector<bool> rattler;  ///< one entry per grain, or empty: none is marked
  std::vector<ContactLine<Dim>> lines;
  std::string force_unit;  ///< in words for the legend, such as "F₀"
  std::string force_symbol = "F";
  // Names of kinds of lines in the legend.
  std::string compression_name = "compression";
  std::string tension_name = "tension";
  std::string background_name = "other contacts";
  std::vector<DisplacementArrow<Dim>> arrows;
  std::optional<Slab> slab;  ///< part of the cell that is shown, see part_in_slab()
  GrainShade shade;          ///< without values: grains are grey
  /// Caption above the picture, broken between these parts if they do not fit on one line.
  std::vector<std::string> caption;
  std::string note;  ///< note in the legend; may be empty
};

/// Returns a picture of the cell and the grains of a packing.
template <int Dim>
PackingPicture<Dim> grains_of(const Packing<Dim>& packing);

/// Returns the part of a picture in a slab: grains whose centres lie in it, their arrows, and lines between two
/// of them. A centre on the border between two slabs is in the upper one.
PackingPicture<3> part_in_slab(const PackingPicture<3>& picture, const Slab& slab);

}  // namespace floc
