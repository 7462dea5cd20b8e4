#pragma once

#include <string>
#include <vector>

#include "floc/base/vec.h"
#include "floc/geometry/cell.h"
#include "floc/packing/packing.h"

namespace floc {

/// What a line between two grains means; drawn in this order, the last on top.
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
struct ContactLine {
  Vec<2> from = Vec<2>::Zero();
  Vec<2> to = Vec<2>::Zero();  ///< centre of the image of the other grain
  LineKind kind = LineKind::compression;
  double force = 0.0;  ///< its size, in `PackingPicture::force_unit`: what the width is proportional to
};

/// Where a grain went.
struct DisplacementArrow {
  Vec<2> from = Vec<2>::Zero();
  Vec<2> displacement = Vec<2>::Zero();
};

/// A value of every grain, shown as its colour.
struct GrainShade {
  std::vector<double> value;  ///< of each grain, in units of `unit`
  double largest = 1.0;       ///< the value that has the last colour, > 0; beyond it colours stay
  std::string name;           ///< what it is, in the legend
};

/// A packing of disks as it is to be drawn, in the length of the state: grains, lines, arrows, colours. Nothing
/// here is cut or copied yet: the drawing repeats all of it periodically and cuts it at the border of the cell.
struct PackingPicture {
  Cell<2> cell;
  std::vector<Vec<2>> position;
  std::vector<double> radius;
  std::vector<bool> rattler;  ///< one entry a grain, or empty: none is marked
  std::vector<ContactLine> lines;
  std::string force_unit;  ///< in words for the legend, such as "F₀"
  std::string force_symbol = "F";
  // Names of kinds of lines in the legend.
  std::string compression_name = "compression";
  std::string tension_name = "tension";
  std::string background_name = "other contacts";
  std::vector<DisplacementArrow> arrows;
  GrainShade shade;  ///< without values: grains are grey
  /// Above the picture, broken between these parts where they do not fit one line.
  std::vector<std::string> caption;
  std::string note;  ///< in the legend, may be empty
};

/// Cell and grains of a packing.
PackingPicture grains_of(const Packing<2>& packing);

}  // namespace floc
