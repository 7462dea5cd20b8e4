#pragma once

#include <string>

namespace floc {

/// Returns a text in single quotes, so that a shell reads it as one argument.
std::string shell_quoted(const std::string& text);

/// Returns a text in the form in which a shell reads it as one argument. The text is put in single quotes only if it
/// contains characters that the shell would interpret.
std::string shell_word(const std::string& text);

}  // namespace floc
