#pragma once

#include <string>

namespace floc {

/// Returns the duration (s) that a text such as "90 s", "30min", "2h", "1.5 d" or "3 years" gives. A number without a
/// unit is in seconds.
/// @param name  option whose value is the text, for messages
/// @throws InputError if the text is not a positive number with one of these units
double duration_of(const std::string& name, const std::string& text);

/// Returns a duration as text, such as "2.5 h". The unit is the largest of s, min, h, d and y that is not longer than
/// the duration.
std::string duration_in_words(double seconds);

}  // namespace floc
