#pragma once

#include <string_view>

#include "floc/base/double_double.h"

namespace floc {

/// Returns the number in a decimal text as a double-double number: the nearest double plus a remainder. Calculations
/// for which a double is not precise enough use this number. If a text has at most 17 significant digits, it is taken
/// for a printed double, and the remainder is zero.
///
/// @param text  a decimal number that parse_number<double>() can read
/// @param nearest  the double that parse_number<double>() returned for `text`
DoubleDouble decimal(std::string_view text, double nearest);

}  // namespace floc
