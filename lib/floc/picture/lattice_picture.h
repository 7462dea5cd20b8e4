#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/lattice.h"
#include "floc/picture/cross_section.h"
#include "floc/picture/palette.h"
#include "floc/picture/picture_format.h"

namespace floc {

/// Colours of the nodes of a lattice, and texts, for draw_lattice(). A node is drawn as the region of all points to
/// which it is the nearest node, for example a hexagon in 2D.
template <int Dim>
struct LatticePicture {
  std::vector<Color> color;  ///< colour of each node
  /// Indices of broken bonds. A broken bond is drawn as a line between the regions of its two nodes, so that cracks are
  /// visible.
  std::vector<int> faces;
  std::string caption;
  /// Colours and their meanings, which the legend lists.
  std::vector<std::pair<Color, std::string>> meanings;
  /// Name of the quantity of the colour bar, which goes from -bar_largest to bar_largest. If empty, there is no colour
  /// bar.
  std::string bar_name;
  double bar_largest = 1.0;
};

/// Layout of the picture of a lattice.
struct LatticeSheetOptions {
  PictureFormat format = PictureFormat::svg;
  double width = 482.0;  ///< width of the page (points)
  CrossSection cut;      ///< 3D: section that is drawn
  /// Number of pixels per lattice spacing, reduced if a side of the picture would exceed 3000 pixels.
  double pixels_a_node = 4.0;

  static constexpr NumberRange kPixels{.least = 1.0, .most = 100.0};
  /// Returns all errors of the options, as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Returns whether draw_lattice() can draw a lattice in this cell. The first cell vector has to lie along the first
/// axis, and the second cell vector in the plane of the first two axes. The picture of such a lattice shows a
/// rectangular box whose sides are the diagonal elements of the cell matrix. Even if the cell is slanted, the box
/// contains each point of the periodic lattice once.
template <int Dim>
bool can_be_drawn(const Cell<Dim>& cell) {
  return cell.matrix.isLowerTriangular(0.0);
}

/// Draws a lattice.
/// @return content of the picture file; in svg and pdf files, the nodes are drawn as an embedded image, and all other
/// elements as vector graphics
/// @pre can_be_drawn(lattice.cell)
/// @throws InputError naming the errors of the options
template <int Dim>
std::string draw_lattice(const Lattice<Dim>& lattice, const LatticePicture<Dim>& picture,
                         const LatticeSheetOptions& options);

/// Returns the colour of each node for its stress: blue for compression, orange for tension, white for zero, and grey
/// if the node has no stress. The colour scale goes from -largest to `largest`; stresses beyond an end have the colour
/// of this end.
/// @param value  stress of each node
/// @param there  whether the node has a stress
std::vector<Color> stress_colors(const std::vector<double>& value, const std::vector<bool>& there,
                                 double largest);

}  // namespace floc
