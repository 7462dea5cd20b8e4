#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Returns the text of a file in UTF-8, or of stdin for "-", without the byte order mark that some editors put
/// before it.
/// @throws InputError if the file cannot be read, or as require_text()
std::string read_text(const std::string& path);

/// Checks the encoding and the ends of lines of a text, for readers that take a file piece by piece.
///
/// @param beginning  of the text, its first line at least
/// @throws InputError if it is in UTF-16 or UTF-32, or its lines end in carriage returns alone
void require_text(const std::string& place, std::string_view beginning);

/// Returns `text` without the byte order mark of UTF-8.
std::string_view without_byte_order_mark(std::string_view text);

/// Returns advice for a message about `text`, which is not a number: the change to make if the reason is a
/// decimal comma, otherwise an empty string.
std::string decimal_comma_hint(std::string_view text);

}  // namespace floc
