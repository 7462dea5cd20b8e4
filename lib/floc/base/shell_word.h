#pragma once

#include <string>

namespace floc {

/// Returns a text in single quotes, so that a shell reads it as one argument.
std::string shell_quoted(const std::string& text);

/// Returns a text so that a shell reads it as one argument: in single quotes if it contains characters that the shell
/// would interpret, otherwise unchanged.
std::string shell_word(const std::string& text);

}  // namespace floc
