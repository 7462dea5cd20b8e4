#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// Splits a line of a table into its cells. A cell may be enclosed in double quotes. Within the quotes, separators
/// belong to the cell, line ends become blanks, and two double quotes denote one.
/// @param separator  character between the cells; a blank denotes any number of blanks and tabs
/// @return the cells; nothing if a cell has no closing quotation mark
std::optional<std::vector<std::string>> split_cells(std::string_view line, char separator);

/// If `text` is a number with a decimal comma, such as "-0,950" or "1,5e-3", returns it with a decimal point. If not,
/// returns an empty text.
std::string with_decimal_point(std::string_view text);

/// Whether a cell of a table is a finite number.
/// @param decimal_commas  whether numbers may have a decimal comma
bool is_number(std::string_view cell, bool decimal_commas);

/// Returns the number of cells, not counting the empty cells at the end.
std::size_t without_trailing_empties(const std::vector<std::string>& cells);

}  // namespace floc
