#pragma once

#include <string>

#include "floc/contact/law.h"

namespace floc {

/// Reads a contact law from one line with the keys of a scene below `contact`, for example "normal.stiffness=1e5,
/// friction.coefficient=0.5, friction.stiffness=1e5".
/// @param place  name of the text in messages
/// @throws InputError for an unknown key, a value that is not a number, a parameter without those that it requires,
/// or an invalid value
Law parse_law(const std::string& place, const std::string& text);

/// Returns the line that parse_law() reads as this law, with all digits of every number.
std::string law_text(const Law& law);

}  // namespace floc
