#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/io/csv.h"
#include "floc/structure/contact_directions.h"
#include "plots/gnuplot.h"

namespace floc {

/// Plots the results of all tests of a load path in which one axis is driven. The stress ratio q/p (deviator to mean
/// stress) and the volumetric strain are plotted against the axial strain since the start of the test, and the lateral
/// stress ratio K0 against the stress on the driven axis. For simple shear, the ratio tau/sigma of shear to normal
/// stress is plotted against the shear strain. Each stage of the load path is a separate line.
/// @param path  table path.csv of a run
/// @throws InputError if a column is missing, or if no row belongs to a test with a driven axis
Plot axial_test_plot(const CsvTable& path);

/// Plots polar diagrams (roses) of the contact directions in one colour per state. A full line shows all contacts, and
/// a dashed line only the strong contacts.
Plot fabric_plot(const std::vector<std::pair<std::string, ContactDirections>>& states);

}  // namespace floc
