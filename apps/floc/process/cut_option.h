#pragma once

#include <string>

#include "floc/picture/cross_section.h"

namespace floc {

/// Parses the value of the option --cut, AXIS,FRACTION. @throws InputError if it is invalid
CrossSection parse_cut(const std::string& text);

}  // namespace floc
