#pragma once

#include <string>

namespace floc {

/// A text as one argument of a shell, in single quotes.
std::string shell_quoted(const std::string& text);

/// The same, without quotes where the shell takes the text as it is.
std::string shell_word(const std::string& text);

}  // namespace floc
