#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// A row of a table that is not blank. If a quoted cell contains line ends, the row extends over several lines.
struct TableLine {
  int number;  ///< number (from 1) of the line of the file in which the row begins
  std::string_view text;
};

/// Lines of the text of a table, without blank lines.
struct TableLines {
  std::vector<TableLine> rows;      ///< lines that are not comments
  std::vector<TableLine> comments;  ///< comments above the first row, without the character #
};

/// Returns the lines of a text. Lines that begin with # are comments. A first line such as "sep=;", which some
/// spreadsheets write, is left out; the separator is found from the other lines.
TableLines table_lines(std::string_view text);

/// Layout of a table: the separator of its cells, the lines that name the columns, and the beginning of its rows.
struct TableLayout {
  char separator = ',';  ///< comma, semicolon, tab, or a blank for any number of blanks
  std::vector<std::string> names;
  /// Other names of the columns, from the lines above the line of `names`. Each inner list has at most one name per
  /// column.
  std::vector<std::vector<std::string>> other_names;
  std::vector<std::string> units;  ///< units from a row of units below the names; empty if there is none
  int names_line = 0;              ///< number of the line of `names`, from 1; 0 if no line names the columns
  int units_line = 0;              ///< number of the row of units; 0 if there is none
  /// number of the last line above the names, comments not counted; 0 if there is no such line
  int last_title_line = 0;
  std::size_t first_row = 0;  ///< index in TableLines::rows of the first row of data
};

/// Finds the layout of a table from its first lines.
///
/// Separator: with the chosen separator, most cells of the rows are numbers, and the rows have as many cells as the
/// line of the names.
///
/// Rows of data: the first row is the first line that has the usual number of cells and enough numbers. Let m be the
/// largest count of numbers in a line; a count above m/2 is enough. If a line contains two of the wanted names, the
/// first row is below this line.
///
/// Names: candidates are the lines directly above the data with as many cells as the data. The line with the most
/// wanted names is chosen. If several lines have equally many wanted names, the line with the most words is chosen; if
/// the numbers of words are equal, too, the last of these lines is chosen. If the table begins with numbers, the names
/// are taken from a comment above the numbers that has one word per column.
///
/// Units: a row between the names and the data in which all cells, or at least half of them, are units.
/// @param wanted  names of columns that the caller needs
TableLayout find_table_layout(const TableLines& lines, const std::vector<std::string>& wanted);

/// Returns the name of a separator for a sentence, such as "semicolons".
const char* separator_words(char separator);

}  // namespace floc
