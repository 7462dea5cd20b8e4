#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace floc {

/// A line of a table that is not blank. It contains line ends if a quoted cell does.
struct TableLine {
  int number;  ///< number of the line in its file, from 1; of several lines, of the first one
  std::string_view text;
};

/// Lines of the text of a table, without blank lines.
struct TableLines {
  std::vector<TableLine> rows;      ///< lines that are no comments
  std::vector<TableLine> comments;  ///< comments above the first of these lines, without the sign #
};

/// Returns the lines of a text. Lines that begin with # are comments. A first line such as "sep=;", which some
/// spreadsheets write, is left out; the separator follows from the other lines.
TableLines table_lines(std::string_view text);

/// How a table is written: what separates its cells, which of its lines name the columns, and where its rows begin.
struct TableLayout {
  char separator = ',';  ///< comma, semicolon, tab, or a blank for any number of blanks
  std::vector<std::string> names;
  /// Further names of the columns, from lines above that of `names`; each list has at most one name per column.
  std::vector<std::vector<std::string>> other_names;
  std::vector<std::string> units;  ///< from a row of units below the names; empty if there is none
  int names_line = 0;              ///< number of the line of `names`, from 1; 0 if no line names the columns
  int units_line = 0;              ///< number of the row of units; 0 if there is none
  int last_title_line = 0;  ///< number of the last line above the names that is no comment; 0 if there is none
  std::size_t first_row = 0;  ///< index in TableLines::rows of the first row of data
};

/// Finds the layout of a table from its first lines.
///
/// The separator is the one with which most cells of the rows are numbers and the rows have as many cells as the line of
/// the names. The rows of data begin with the first line that has the usual number of cells and more than half of the
/// usual number of numbers, below a line with two of the wanted names if there is one. Of the lines right above it that have as many cells, the line of the names is the one with
/// the most wanted names, then the one with the most words, then the last one. A row between the names and the data
/// that contains nothing but units gives the units. If the table begins with numbers, the names are those of a comment
/// above them that has one word per column, if there is such a comment.
/// @param wanted  names of columns that the caller looks for
TableLayout find_table_layout(const TableLines& lines, const std::vector<std::string>& wanted);

/// Name of a separator in a sentence, such as "semicolons".
const char* separator_words(char separator);

}  // namespace floc
