#pragma once

#include <cairo.h>

#include <string>

#include "floc/picture/picture_format.h"

namespace floc {

/// A white page on which cairo draws. The origin is the upper left corner, and lengths are in points (1/72 inch). The
/// picture file contains no date, so that equal drawings give equal files.
class Page {
 public:
  /// @param pixels_per_point  resolution of a png file, or of the embedded images in a file of another format
  Page(PictureFormat format, double width, double height, double pixels_per_point);
  ~Page();
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  cairo_t* context() const { return context_; }

  /// Returns the content of the picture file. The page cannot be drawn on afterwards.
  /// @throws std::runtime_error with the error message of cairo
  std::string finish();

 private:
  PictureFormat format_;
  std::string bytes_;
  cairo_surface_t* surface_;
  cairo_t* context_;
};

/// Pixel image of a rectangle of a page. An image is used if a drawing has so many shapes that vector graphics would be
/// slow to display. The shapes are drawn on the context() of the image. The destructor paints the image on the page.
class ImageLayer {
 public:
  /// @param left,top,width,height  rectangle of the page that the image covers (points)
  ImageLayer(cairo_t* page, double left, double top, double width, double height, double pixels_per_point);
  ~ImageLayer();
  ImageLayer(const ImageLayer&) = delete;
  ImageLayer& operator=(const ImageLayer&) = delete;

  /// Returns the cairo context of the image, in which positions are given in the coordinates of the page.
  cairo_t* context() const { return context_; }

 private:
  cairo_t* page_;
  double left_, top_;
  cairo_surface_t* image_;
  cairo_t* context_;
};

}  // namespace floc
