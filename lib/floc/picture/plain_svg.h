#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Returns an svg of cairo in a smaller form that does not depend on earlier drawings of the process. Names of
/// surfaces and images, which cairo counts through a process, are numbered in the order of their appearance,
/// and coordinates of paths have two decimals (a hundredth of a point) in place of six.
std::string plain_svg(std::string_view svg);

}  // namespace floc
