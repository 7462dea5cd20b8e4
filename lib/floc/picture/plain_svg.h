#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Returns an svg written by cairo in a smaller form that does not depend on earlier drawings of this process. cairo
/// counts the names of surfaces and images through the whole process; here they are numbered in the order in which they
/// appear in the svg. Coordinates of paths have two decimals (a hundredth of a point) instead of six.
std::string plain_svg(std::string_view svg);

}  // namespace floc
