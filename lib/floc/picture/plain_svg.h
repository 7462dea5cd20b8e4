#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Converts an svg written by cairo to a smaller form that does not depend on earlier drawings of this process. The
/// names that cairo gives to surfaces and images contain numbers that go on from one drawing to the next; here they are
/// numbered in the order in which they appear in the svg. Coordinates of paths have two decimals (a hundredth of a
/// point) instead of six.
std::string plain_svg(std::string_view svg);

}  // namespace floc
