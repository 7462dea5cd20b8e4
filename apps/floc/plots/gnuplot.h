#pragma once

#include <string>
#include <utility>
#include <vector>

namespace floc {

/// A plot for gnuplot: blocks of numbers, and a script that refers to block N, counted from 0, as `data index N`.
struct Plot {
  /// A table of numbers. In the data file, a comment with the names of the columns precedes the numbers. A block
  /// without rows is also written, so that the indices of later blocks do not depend on it.
  struct Block {
    std::string columns;
    std::vector<std::vector<double>> rows;
  };
  std::vector<Block> blocks;
  std::string script;             ///< gnuplot commands that follow the commands for terminal, output and data
  int width = 720, height = 520;  ///< size of the plot (1/96 inch)

  /// Adds a block. @return index of the block
  int add(const std::string& columns, std::vector<std::vector<double>> rows);
};

/// Returns the smallest and the largest finite value in column `column` of the blocks with the indices `blocks`.
/// Without such a value, the first of the two returned numbers is larger than the second.
/// @param positive  whether only values above zero count
std::pair<double, double> value_range(const Plot& plot, const std::vector<int>& blocks, int column,
                                      bool positive);

/// Returns the gnuplot command that sets the range of an axis ("x" or "y") so that the range contains the values in
/// column `column` of the blocks with the indices `blocks`. The margin is a tenth of a decade on a logarithmic axis and
/// a twentieth of the range on a linear axis. The command is empty if there are no two different values.
std::string range_script(const Plot& plot, const std::string& axis, const std::vector<int>& blocks, int column,
                         bool logarithmic);

/// Formats a value with its error, as in "0.197 ± 0.090". The error has two significant digits. The value has as many
/// decimals as the error.
std::string value_and_error(double value, double error);

/// Returns a text as a gnuplot string in single quotes.
std::string gnuplot_quoted(const std::string& text);

/// Checks the name of a picture, for commands whose work takes long.
/// @throws InputError if the name does not end in .svg, .pdf or .png
/// @throws IoError if the directory of the picture does not exist
void require_plot_name(const std::string& file);

/// Writes the picture F.svg, F.pdf or F.png, with its data in F.dat and its gnuplot script in F.gp, and runs gnuplot to
/// draw it. An interrupted call leaves no incomplete file. A user can edit the script and run it in its directory to
/// draw the picture again.
/// @throws InputError if the name has another extension; IoError if a file cannot be written, or if gnuplot is missing
/// or fails
void write_plot(const std::string& file, const Plot& plot);

/// Returns the plot as the text of an svg file. Temporary files are removed.
/// @throws IoError if a temporary file cannot be written, or if gnuplot is missing or fails
std::string plot_as_svg(const Plot& plot);

}  // namespace floc
