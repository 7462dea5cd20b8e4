#pragma once

#include <string>

namespace floc {

/// Returns a text as one argument of a shell, in single quotes.
std::string shell_quoted(const std::string& text);

/// Returns a text as one argument of a shell, quoted only if the shell would not take it as it is.
std::string shell_word(const std::string& text);

}  // namespace floc
