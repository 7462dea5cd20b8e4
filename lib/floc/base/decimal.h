#pragma once

#include <string_view>

#include "floc/base/double_double.h"

namespace floc {

/// The number of a decimal text, where a double is not precise enough: the nearest double and
/// what is left. Texts of up to 17 significant digits are those of a double, which programs print so: nothing
/// is left.
///
/// @param text     a decimal number that parse_number<double>() reads
/// @param nearest  what it read
DoubleDouble decimal(std::string_view text, double nearest);

}  // namespace floc
