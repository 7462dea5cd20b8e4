#pragma once

#include <string>
#include <string_view>

namespace floc {

/// Text of a table in UTF-8, whose lines end in "\n" or "\r\n".
struct TableText {
  std::string text;
  /// Name of the encoding of the file, such as "Latin-1"; empty for UTF-8.
  std::string encoding;
};

/// Converts the bytes of a table to UTF-8. UTF-8 and UTF-16 are recognised, each with or without byte order mark. Any
/// other text is taken as Latin-1 with the additional characters of Windows (code page 1252). Carriage returns that end
/// lines on old Macs are replaced by the line ends of Unix. Minus signs are replaced by hyphens, and no-break spaces by
/// blanks.
/// @param place  name of the file, for messages
/// @throws InputError if the text is in UTF-32
TableText decoded_table(const std::string& place, std::string bytes);

/// Returns the text of the first 64 KiB of a file. Callers use this text to recognise the format of a table.
/// @throws InputError under the conditions of read_beginning() and decoded_table()
std::string beginning_of_table(const std::string& path);

/// Reads the text of a table from a file, or from the standard input if the path is "-".
/// @throws InputError if the file cannot be read, or under the conditions of decoded_table()
TableText read_table_text(const std::string& path);

}  // namespace floc
