#pragma once

#include <string>
#include <string_view>

namespace floc {

/// An svg of cairo's made smaller, and the same whatever the process drew before: names of surfaces and images,
/// which cairo counts through a process, are numbered in their order here, and coordinates of paths have two
/// decimals (a hundredth of a point) in place of six.
std::string plain_svg(std::string_view svg);

}  // namespace floc
