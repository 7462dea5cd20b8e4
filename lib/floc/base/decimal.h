#pragma once

#include <string_view>

#include "floc/base/double_double.h"

namespace floc {

/// Returns the number that a decimal text represents as a double-double number: the nearest double and the remainder.
/// It serves where a double is not precise enough. A text of up to 17 significant digits is taken as a double that a
/// program has printed, so its remainder is zero.
///
/// @param text  a decimal number that parse_number<double>() can read
/// @param nearest  the double that parse_number<double>() returned for `text`
DoubleDouble decimal(std::string_view text, double nearest);

}  // namespace floc
