#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/io/csv.h"
#include "floc/structure/contact_directions.h"
#include "plots/gnuplot.h"

namespace floc {

/// Plots the results of tests with a driven axis: q/p and volumetric strain against the axial strain since the test
/// began, and K0 against the driven stress; for simple shear, tau/sigma against the shear strain. Every stage of the
/// load path is a line of its own.
/// @param path  table path.csv of floc run  @throws InputError if a column is missing, or no row belongs to such a test
Plot axial_test_plot(const CsvTable& path);

/// Plots rose diagrams of the directions of contacts, one colour per state: of all contacts, and of the strong ones.
Plot fabric_plot(const std::vector<std::pair<std::string, ContactDirections>>& states);

}  // namespace floc
