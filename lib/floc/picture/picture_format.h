#pragma once

namespace floc {

/// What a picture is written as.
enum class PictureFormat { svg, pdf, png };

}  // namespace floc
