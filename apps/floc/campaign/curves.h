#pragma once

#include <string>
#include <vector>

#include "floc/io/csv.h"

namespace floc {

/// Returns the columns of the table of means that can be drawn as a curve: some case has their values at two pressures
/// or more.
std::vector<std::string> curve_quantities(const CsvTable& means);

/// Draws one quantity against P* as svg within a page. Each case is a group of class "curve" with its label in
/// data-case: the mean over the samples as a line with points, and a band from the lowest to the highest sample.
/// @param labels  labels of the cases, in the order of their colours
std::string curves_svg(const CsvTable& means, const std::string& quantity,
                       const std::vector<std::string>& labels);

/// Returns the colour of a case by its number, from 0.
std::string curve_colour(std::size_t number);

}  // namespace floc
