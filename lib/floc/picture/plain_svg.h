#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Converts an svg text of cairo to a shorter text that does not depend on earlier drawings of this process. Cairo
/// continues the numbers of its surfaces and images from one drawing to the next. This function replaces them by
/// numbers in the order in which the surfaces and images appear in the svg. Coordinates of paths (points) are rounded
/// from six decimals to two.
std::string plain_svg(std::string_view svg);

}  // namespace floc
