#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/picture/packing_picture.h"
#include "floc/picture/picture_format.h"
#include "floc/picture/view.h"

namespace floc {

/// Layout of a page with pictures of packings. The defaults suit packings of a hundred to a hundred thousand grains.
struct SheetOptions {
  PictureFormat format = PictureFormat::svg;
  double width = 482.0;  ///< width of the page (points); the default is 17 cm, two columns of a journal
  int columns = 4;       ///< number of columns if there are several pictures, >= 1
  /// Width, in mean diameters, of the line for a force equal to the root mean square of all forces of the picture. With
  /// the default, the line of the largest of thousands of forces is about as wide as a grain, because forces in
  /// granular media have about an exponential distribution.
  double line_width = 0.15;
  bool same_force_scale = false;  ///< whether all pictures have a common force scale
  bool bare = false;              ///< whether captions and legend are left out
  /// Resolution (pixels per inch) of a png, or of an embedded image of grains and lines. If absent, the resolution is
  /// six pixels per mean diameter, but such that a side of the page has at most 3000 pixels. The resolution is never
  /// below 200 pixels per inch (in 3D, 300).
  std::optional<double> resolution;
  /// Whether grains and lines in an svg or pdf file are drawn as an embedded image; all other elements are vector
  /// graphics. If absent, an image is used for more than 15 000 grains and lines (in 3D, more than 6 000 visible
  /// shapes), because a file with so many vector shapes would take megabytes.
  std::optional<bool> as_image;
  View view;  ///< viewpoint for packings in 3D

  /// Returns all errors of the options, as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Draws one picture, or several pictures side by side with a common length scale. The page has captions and a legend
/// with a scale bar and a force scale. In 2D, grains and lines are cut at the borders of the cell. In 3D, the grains
/// are shaded, tubes show contact forces, nearer grains hide farther grains, and the edges of the cell and the names of
/// its axes are drawn.
/// @return content of the picture file
/// @pre there is at least one picture, and each has at least one grain
/// @throws InputError naming the errors of the options
template <int Dim>
std::string draw_sheet(const std::vector<PackingPicture<Dim>>& pictures, const SheetOptions& options);

}  // namespace floc
