#pragma once

#include <string>

#include "floc/contact/law.h"

namespace floc {

/// Reads a contact law from one line. The keys are the keys that a scene file has in its table `contact`, for example
/// "normal.stiffness=1e5, friction.coefficient=0.5, friction.stiffness=1e5".
/// @param place  name of the text in messages
/// @throws InputError for an unknown key, a value that is not a number, a missing parameter, or an invalid value
Law parse_law(const std::string& place, const std::string& text);

/// Returns a contact law as a line of text that parse_law() converts back into exactly this law.
std::string law_text(const Law& law);

}  // namespace floc
