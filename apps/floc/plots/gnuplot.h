#pragma once

#include <string>
#include <vector>

namespace floc {

/// A plot as gnuplot draws it: numbers, and a script that names them `data` and its blocks by `index`, from 0.
struct Plot {
  /// Lines of numbers, each block begun by a comment that names its columns. A block without lines is kept, so
  /// that the others keep their index.
  struct Block {
    std::string columns;
    std::vector<std::vector<double>> rows;
  };
  std::vector<Block> blocks;
  std::string script;             ///< what follows terminal, output and data
  int width = 720, height = 520;  ///< (points of a screen, 1/96 inch)

  /// Adds a block. @return its index
  int add(const std::string& columns, std::vector<std::vector<double>> rows);
};

/// The line that sets an axis ("x", "y") to hold column `column` of some blocks, with a margin of a tenth of a
/// decade or, on a linear axis, of a twentieth of the range. Empty where there are no two different values.
std::string range_script(const Plot& plot, const std::string& axis, const std::vector<int>& blocks, int column,
                         bool logarithmic);

/// "0.197 ± 0.090": an error with two digits, the value to the same decimals.
std::string value_and_error(double value, double error);

/// Text as gnuplot takes it in single quotes.
std::string gnuplot_quoted(const std::string& text);

/// Writes F.dat and F.gp beside F.svg, F.pdf or F.png and has gnuplot draw it; each file is whole or absent.
/// Run again in its directory, the script draws the same picture, so that it can be restyled.
/// @throws InputError if the name ends otherwise; IoError if a file cannot be written, or gnuplot is missing or
/// fails
void write_plot(const std::string& file, const Plot& plot);

/// The picture alone, as svg.
/// @throws IoError as above
std::string plot_as_svg(const Plot& plot);

}  // namespace floc
