#include "floc/picture/page.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <cmath>
#include <stdexcept>

#include "floc/picture/plain_svg.h"

namespace floc {
namespace {

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* image_of(double width, double height, double pixels_per_point) {
  cairo_surface_t* image =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width * pixels_per_point)),
                                 static_cast<int>(std::ceil(height * pixels_per_point)));
  cairo_surface_set_device_scale(image, pixels_per_point, pixels_per_point);
  cairo_t* whole = cairo_create(image);
  cairo_set_source_rgb(whole, 1.0, 1.0, 1.0);
  cairo_paint(whole);
  cairo_destroy(whole);
  return image;
}

cairo_surface_t* surface_of(PictureFormat format, double width, double height, double pixels_per_point,
                            std::string* bytes) {
  switch (format) {
    case PictureFormat::svg:
      return cairo_svg_surface_create_for_stream(append, bytes, width, height);
    case PictureFormat::pdf:
      return cairo_pdf_surface_create_for_stream(append, bytes, width, height);
    case PictureFormat::png:
      break;
  }
  return image_of(width, height, pixels_per_point);
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("cairo: ") + cairo_status_to_string(status));
}

}  // namespace

Page::Page(PictureFormat format, double width, double height, double pixels_per_point)
    : format_(format),
      surface_(surface_of(format, width, height, pixels_per_point, &bytes_)),
      context_(cairo_create(surface_)) {
  // Without a date, cairo would write the current time into a pdf file.
  if (format == PictureFormat::pdf)
    cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATE_DATE, "");
  cairo_set_source_rgb(context_, 1.0, 1.0, 1.0);
  cairo_paint(context_);
}

Page::~Page() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

std::string Page::finish() {
  check(cairo_status(context_));
  if (format_ == PictureFormat::png) {
    cairo_surface_flush(surface_);
    check(cairo_surface_write_to_png_stream(surface_, append, &bytes_));
  }
  cairo_surface_finish(surface_);
  check(cairo_surface_status(surface_));
  return format_ == PictureFormat::svg ? plain_svg(bytes_) : std::move(bytes_);
}

ImageLayer::ImageLayer(cairo_t* page, double left, double top, double width, double height,
                       double pixels_per_point)
    : page_(page),
      left_(left),
      top_(top),
      image_(image_of(width, height, pixels_per_point)),
      context_(cairo_create(image_)) {
  cairo_translate(context_, -left, -top);
}

ImageLayer::~ImageLayer() {
  cairo_destroy(context_);
  cairo_surface_flush(image_);
  cairo_set_source_surface(page_, image_, left_, top_);
  cairo_paint(page_);
  cairo_surface_destroy(image_);
}

}  // namespace floc
