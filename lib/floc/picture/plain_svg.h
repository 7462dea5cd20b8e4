#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Converts an svg text of cairo to a shorter text that does not depend on earlier drawings of this process. Cairo goes
/// on numbering its surfaces and images from one drawing to the next; here they are numbered again, in the order in
/// which they appear in the svg. Coordinates of paths (points) are rounded from six decimals to two.
std::string plain_svg(std::string_view svg);

}  // namespace floc
