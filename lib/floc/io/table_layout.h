#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// A row of a table that is not blank. It contains line ends if one of its quoted cells does.
struct TableLine {
  int number;  ///< number of the line in its file, from 1; for a row of several lines, that of the first line
  std::string_view text;
};

/// Lines of the text of a table, without blank lines.
struct TableLines {
  std::vector<TableLine> rows;      ///< lines that are not comments
  std::vector<TableLine> comments;  ///< comments above the first of these lines, without the character #
};

/// Returns the lines of a text. Lines that begin with # are comments. A first line such as "sep=;", which some
/// spreadsheets write, is left out, because the separator is found from the other lines.
TableLines table_lines(std::string_view text);

/// Layout of a table: the separator of its cells, the lines that name the columns, and the beginning of its rows.
struct TableLayout {
  char separator = ',';  ///< comma, semicolon, tab, or a blank for any number of blanks
  std::vector<std::string> names;
  /// Other names of the columns, from lines above the line of `names`; each list has at most one name per column.
  std::vector<std::vector<std::string>> other_names;
  std::vector<std::string> units;  ///< units from a row of units below the names; empty if there is none
  int names_line = 0;              ///< number of the line of `names`, from 1; 0 if no line names the columns
  int units_line = 0;              ///< number of the row of units; 0 if there is none
  /// number of the last line above the names that is not a comment; 0 if there is none
  int last_title_line = 0;
  std::size_t first_row = 0;  ///< index in TableLines::rows of the first row of data
};

/// Finds the layout of a table from its first lines.
///
/// Separator: the one for which most cells of the rows are numbers and the rows have as many cells as the line of the
/// names.
///
/// Rows of data: they begin with the first line that has the usual number of cells, and more than half of the usual
/// number of numbers. If a line contains two of the wanted names, they begin below it.
///
/// Names: candidates are the lines directly above the data with as many cells as the data. The line with the most
/// wanted names is chosen; of several such lines, the one with the most words; of several such lines, the last one. If
/// the table begins with numbers, the names are taken from a comment above them that has one word per column, if there
/// is such a comment.
///
/// Units: a row between the names and the data that contains only units.
/// @param wanted  names of columns that the caller needs
TableLayout find_table_layout(const TableLines& lines, const std::vector<std::string>& wanted);

/// Returns the name of a separator for a sentence, such as "semicolons".
const char* separator_words(char separator);

}  // namespace floc
