#pragma once

#include <string>

#include "floc/contact/law.h"

namespace floc {

/// Reads a contact law from one line of text, "key=value, key=value, ...". The keys are those of the table `contact` in
/// a scene file, for example "normal.stiffness=1e5, friction.coefficient=0.5, friction.stiffness=1e5".
/// @param place  name of the text in messages, such as the option that contains it
/// @throws InputError for an unknown key, a value that is not a number, a missing parameter, or an invalid value
Law parse_law(const std::string& place, const std::string& text);

/// Returns a contact law as one line of text. parse_law() converts this text back to exactly the same law.
std::string law_text(const Law& law);

}  // namespace floc
