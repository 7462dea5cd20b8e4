#pragma once

#include <string>
#include <vector>

#include "floc/io/csv.h"

namespace floc {

/// Columns that the table of means has of two pressures or more in some case: those that a curve can be drawn of.
std::vector<std::string> curve_quantities(const CsvTable& means);

/// One quantity against P* as svg within a page: for each case, in the group of class "curve" and data-case = its
/// label, the mean over the samples as a line and points, and all samples as a band from the lowest to the highest.
/// @param labels  of the cases, in the order of their colours
std::string curves_svg(const CsvTable& means, const std::string& quantity,
                       const std::vector<std::string>& labels);

/// Colour of the case of a number, from 0.
std::string curve_colour(std::size_t number);

}  // namespace floc
