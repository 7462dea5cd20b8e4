#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/lattice.h"
#include "floc/picture/palette.h"
#include "floc/picture/picture_format.h"

namespace floc {

/// A lattice to be drawn: each node as its cell, a hexagon in 2D, in the colour of the value or phase that it
/// shows.
template <int Dim>
struct LatticePicture {
  std::vector<Color> color;  ///< colour of each node
  /// Bonds of the lattice that are drawn as the face between their nodes: cracks.
  std::vector<int> faces;
  std::string caption;
  /// Colours and their meanings, for the legend.
  std::vector<std::pair<Color, std::string>> meanings;
  /// Name of a colour bar from the most negative to the most positive; empty: none.
  std::string bar_name;
  double bar_largest = 1.0;
};

/// Layout of the picture.
struct LatticeSheetOptions {
  PictureFormat format = PictureFormat::svg;
  double width = 482.0;        ///< width of the page (points)
  int cut_axis = 1;            ///< 3D: axis across which the section is taken, from 0
  double cut_at = 0.5;         ///< 3D: position of the section along that axis, as a share of the cell
  double pixels_a_node = 4.0;  ///< pixels across the mean node; fewer where a side would exceed 3000 pixels

  static constexpr NumberRange kPixels{.least = 1.0, .most = 100.0};
  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Returns whether draw_lattice() can show a lattice in this cell: the first lattice vector has to lie along
/// the first axis, the second in the plane of the first two. The picture shows the right-angled box whose sides
/// are the diagonal of such a cell: it holds each point of the lattice once, however slanted the cell is.
template <int Dim>
bool can_be_drawn(const Cell<Dim>& cell) {
  return cell.matrix.isLowerTriangular(0.0);
}

/// Draws a lattice.
/// @return the bytes of the file: the nodes as an image, all else as vectors in svg and pdf
/// @pre can_be_drawn(lattice.cell)   @throws InputError with the faults of the options
template <int Dim>
std::string draw_lattice(const Lattice<Dim>& lattice, const LatticePicture<Dim>& picture,
                         const LatticeSheetOptions& options);

/// Returns the colours of a stress over `largest`: blue for compression, orange for tension, white for zero,
/// grey where there is no value.
/// @param there  one entry per value: whether there is one
std::vector<Color> stress_colors(const std::vector<double>& value, const std::vector<bool>& there,
                                 double largest);

}  // namespace floc
