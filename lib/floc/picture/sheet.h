#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/picture/packing_picture.h"
#include "floc/picture/picture_format.h"
#include "floc/picture/view.h"

namespace floc {

/// Layout of packings on a page. The defaults suit a hundred to a hundred thousand grains.
struct SheetOptions {
  PictureFormat format = PictureFormat::svg;
  double width = 482.0;  ///< width of the page (points); 17 cm, two columns of a journal
  int columns = 4;       ///< columns of a film strip, >= 1
  /// Line width of the r.m.s. force, in mean diameters. Forces in granular media are distributed about
  /// exponentially, so the largest of thousands are then about as wide as a grain.
  double line_width = 0.15;
  bool same_force_scale = false;  ///< whether all pictures of a strip have one force scale
  bool bare = false;              ///< whether captions and legend are left out
  /// Pixels per inch of a png, and of grains and lines that are embedded as an image. Absent: six pixels per
  /// mean diameter, but at least 200 (in 3D 300), and at most 3000 pixels per side of the page.
  std::optional<double> resolution;
  /// Whether to draw grains and lines of an svg or pdf as an image. Absent: if there are more than 15 000 of
  /// them (in 3D 6 000 seen), which as vectors would take megabytes. All else is drawn as vectors.
  std::optional<bool> as_image;
  View view;  ///< viewpoint, for spheres

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Draws one picture, or several as a film strip with one length scale for all: grains and lines cut at the
/// borders of the cell, with captions, a legend of the elements drawn, a scale bar in largest diameters and the
/// line width of a force. Spheres are shaded, nearer ones in front of farther ones, with the edges of the cell
/// and the names of its axes; forces between them are tubes.
/// @return the bytes of the file
/// @pre there is a picture, and each has a grain   @throws InputError with the faults of the options
template <int Dim>
std::string draw_sheet(const std::vector<PackingPicture<Dim>>& pictures, const SheetOptions& options);

}  // namespace floc
