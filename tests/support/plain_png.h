#pragma once

#include "floc/picture/sheet.h"

namespace floc::test {

/// Options for a png page of 410 points with margins of five: 100 points per length, one pixel per point.
inline SheetOptions plain_png() {
  SheetOptions options;
  options.format = PictureFormat::png;
  options.width = 410.0;
  options.resolution = 72.0;
  options.bare = true;
  return options;
}

}  // namespace floc::test
