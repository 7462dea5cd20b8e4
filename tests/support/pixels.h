#pragma once

#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include "floc/picture/palette.h"

namespace floc::test {

/// Pixels of a png file.
class Pixels {
 public:
  explicit Pixels(const std::string& png) {
    std::pair<const std::string*, std::size_t> source{&png, 0};
    surface_ = cairo_image_surface_create_from_png_stream(read, &source);
    EXPECT_EQ(cairo_surface_status(surface_), CAIRO_STATUS_SUCCESS);
  }
  ~Pixels() { cairo_surface_destroy(surface_); }
  Pixels(const Pixels&) = delete;
  Pixels& operator=(const Pixels&) = delete;

  int width() const { return cairo_image_surface_get_width(surface_); }
  int height() const { return cairo_image_surface_get_height(surface_); }
  int rgb(int x, int y) const {
    std::uint32_t pixel = 0;
    std::memcpy(&pixel,
                cairo_image_surface_get_data(surface_) + y * cairo_image_surface_get_stride(surface_) + 4 * x,
                4);
    return static_cast<int>(pixel & 0xFFFFFF);
  }
  /// Mean of (255 - grey)/255 over all pixels: 0 for white, 1 for black.
  double ink() const {
    double sum = 0.0;
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x) {
        const int c = rgb(x, y);
        sum += 1.0 - ((c >> 16 & 255) + (c >> 8 & 255) + (c & 255)) / 765.0;
      }
    return sum / (static_cast<double>(width()) * height());
  }

 private:
  static cairo_status_t read(void* source, unsigned char* data, unsigned int length) {
    auto& [bytes, place] = *static_cast<std::pair<const std::string*, std::size_t>*>(source);
    if (place + length > bytes->size()) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(data, bytes->data() + place, length);
    place += length;
    return CAIRO_STATUS_SUCCESS;
  }
  cairo_surface_t* surface_;
};

inline int rgb_of(const Color& c) {
  const auto byte = [](double x) { return static_cast<int>(std::lround(255.0 * x)); };
  return byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

}  // namespace floc::test
