#pragma once

#include <string>
#include <vector>

namespace floc {

/// A plot as gnuplot draws it: blocks of numbers, and a script that refers to them as `data index N`, N from 0.
struct Plot {
  /// Lines of numbers. In the data file a comment that names the columns precedes each block. A block without lines is
  /// kept, so that the indices of the others do not change.
  struct Block {
    std::string columns;
    std::vector<std::vector<double>> rows;
  };
  std::vector<Block> blocks;
  std::string script;             ///< gnuplot commands that follow those of terminal, output and data
  int width = 720, height = 520;  ///< size of the plot (1/96 inch)

  /// Adds a block. @return its index
  int add(const std::string& columns, std::vector<std::vector<double>> rows);
};

/// Returns the command that sets the range of an axis ("x", "y") to that of a column of some blocks, with a margin of a
/// tenth of a decade or, on a linear axis, of a twentieth of the range. Empty if there are no two different values.
std::string range_script(const Plot& plot, const std::string& axis, const std::vector<int>& blocks, int column,
                         bool logarithmic);

/// Formats a value with its error, "0.197 ± 0.090": the error has two digits, and the value as many decimals.
std::string value_and_error(double value, double error);

/// Returns text as a gnuplot string in single quotes.
std::string gnuplot_quoted(const std::string& text);

/// Writes F.dat and F.gp beside F.svg, F.pdf or F.png and runs gnuplot to draw it; each file is complete or absent. The
/// script draws the picture again when it is run in its directory, so that a user can edit its style.
/// @throws InputError if the name has another extension; IoError if a file cannot be written, or gnuplot is missing or
/// fails
void write_plot(const std::string& file, const Plot& plot);

/// Returns the picture as svg, without writing its files.
/// @throws IoError under the conditions of write_plot()
std::string plot_as_svg(const Plot& plot);

}  // namespace floc
