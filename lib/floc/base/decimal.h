#pragma once

#include <string_view>

#include "floc/base/double_double.h"

namespace floc {

/// Returns the number that a decimal text represents, for use where a double is not precise enough: the nearest
/// double and the remainder. Texts of up to 17 significant digits are taken as doubles that a program has
/// printed, so that their remainder is zero.
///
/// @param text     a decimal number that parse_number<double>() reads
/// @param nearest  the double that parse_number() returned for it
DoubleDouble decimal(std::string_view text, double nearest);

}  // namespace floc
