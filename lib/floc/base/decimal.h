#pragma once

#include <string_view>

#include "floc/base/double_double.h"

namespace floc {

/// Returns the number in a decimal text as a double-double number: the nearest double plus a remainder. Calculations
/// use this number if a double is not precise enough. A text with up to 17 significant digits is interpreted as a
/// printed double, with a remainder of zero.
///
/// @param text  a decimal number that parse_number<double>() can read
/// @param nearest  the double that parse_number<double>() returned for `text`
DoubleDouble decimal(std::string_view text, double nearest);

}  // namespace floc
