#pragma once

namespace floc {

/// File format of a picture.
enum class PictureFormat { svg, pdf, png };

}  // namespace floc
