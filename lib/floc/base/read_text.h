#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Returns the text of a UTF-8 file, or of the standard input if the path is "-". A byte order mark, which some editors
/// put at the beginning of a file, is removed.
/// @throws InputError if the file cannot be read, or if require_text() rejects its encoding or its line ends
std::string read_text(const std::string& path);

/// Checks the encoding and the line ends of a text, for functions that read a file piece by piece.
///
/// @param place  name of the file, for messages
/// @param beginning  the beginning of the text, with at least its first line
/// @throws InputError if the text is in UTF-16 or UTF-32, or if its lines end in "\r" without "
/// "
void require_text(const std::string& place, std::string_view beginning);

/// Returns the name of the encoding of a text if the encoding is UTF-16 or UTF-32, otherwise an empty text. The
/// encoding is recognised by the byte order mark. A text without this mark counts as UTF-16 if exactly one of its first
/// two bytes is zero.
std::string_view foreign_encoding(std::string_view text);

/// Whether the first line of a text ends in "\r" without "
/// ", and more text follows.
bool ends_in_carriage_return(std::string_view text);

/// Returns `text` without the byte order mark of UTF-8 at its beginning, if it has one.
std::string_view without_byte_order_mark(std::string_view text);

/// Returns an addition to the message that `text` is not a number. If the only fault of `text` is a decimal comma, the
/// addition says that a decimal point is expected. Otherwise the addition is empty.
std::string decimal_comma_hint(std::string_view text);

}  // namespace floc
