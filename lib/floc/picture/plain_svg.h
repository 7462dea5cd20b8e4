#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Converts an svg text of cairo to a shorter text that does not depend on earlier drawings of this process. Cairo does
/// not restart the numbers of its surfaces and images for a new drawing. This function numbers them anew, in the order
/// in which they appear in the svg. Coordinates of paths (points) are rounded from six decimals to two.
std::string plain_svg(std::string_view svg);

}  // namespace floc
