#pragma once

#include <string>

namespace floc {

/// Returns a text as a string literal in double quotes, which both Python and TOML read as this text.
std::string string_literal(const std::string& text);

}  // namespace floc
