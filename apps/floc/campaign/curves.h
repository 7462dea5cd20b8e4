#pragma once

#include <string>
#include <vector>

#include "floc/io/csv.h"

namespace floc {

/// Returns the names of the quantities in a table of means that can be drawn as curves: those with values at two or
/// more pressures in at least one case.
std::vector<std::string> curve_quantities(const CsvTable& means);

/// Draws one quantity against the reduced pressure P* as an svg element of an html page. Each case is a group of class
/// "curve", whose attribute data-case is the label of the case. The group shows the mean over the samples as a line
/// with points, and the range from the lowest to the highest sample as a band.
/// @param labels  labels of the cases, in the order of their colours
/// @param pressure  label of the axis of pressures, such as "P*"
std::string curves_svg(const CsvTable& means, const std::string& quantity,
                       const std::vector<std::string>& labels, const std::string& pressure);

/// Returns the colour in which the curves of a case are drawn.
/// @param number  number of the case, counted from 0
std::string curve_colour(std::size_t number);

}  // namespace floc
