#pragma once

#include <cairo.h>

#include <string>

#include "floc/picture/picture_format.h"

namespace floc {

/// A white page that cairo draws on, with the origin at its upper left and lengths in points (1/72 inch). The
/// output contains no time stamp: equal drawings give equal bytes.
class Page {
 public:
  /// @param pixels_per_point  resolution of a png, and of parts embedded as an image
  Page(PictureFormat format, double width, double height, double pixels_per_point);
  ~Page();
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  cairo_t* context() const { return context_; }

  /// Returns the bytes of the picture. The page cannot be drawn on afterwards.
  /// @throws std::runtime_error with cairo's message if it failed
  std::string finish();

 private:
  PictureFormat format_;
  std::string bytes_;
  cairo_surface_t* surface_;
  cairo_t* context_;
};

/// Image, of the same resolution as a png, that receives all drawing while this object exists and is then
/// painted on the page. Used for drawings of so many parts that as vectors they would take too long to show.
class ImageLayer {
 public:
  /// @param left, top, width, height  the part of the page it covers (points)
  ImageLayer(cairo_t* page, double left, double top, double width, double height, double pixels_per_point);
  ~ImageLayer();
  ImageLayer(const ImageLayer&) = delete;
  ImageLayer& operator=(const ImageLayer&) = delete;

  /// Returns the context of the image, which has the coordinates of the page.
  cairo_t* context() const { return context_; }

 private:
  cairo_t* page_;
  double left_, top_;
  cairo_surface_t* image_;
  cairo_t* context_;
};

}  // namespace floc
