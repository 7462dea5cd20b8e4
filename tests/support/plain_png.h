#pragma once

#include "floc/picture/sheet.h"

namespace floc::test {

/// Options for a png page with a width of 410 points and margins of 5 points. A unit of length is 100 points long, and
/// each point is one pixel.
inline SheetOptions plain_png() {
  SheetOptions options;
  options.format = PictureFormat::png;
  options.width = 410.0;
  options.resolution = 72.0;
  options.bare = true;
  return options;
}

}  // namespace floc::test
