#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/io/csv.h"
#include "floc/structure/contact_directions.h"
#include "plots/gnuplot.h"

namespace floc {

/// What tests with a driven axis measure: q/p and volumetric strain over the axial strain since the test began,
/// and K0 over the driven stress; of simple shear tau/sigma over the shear strain. Every turn is a line of its own.
/// @param path  of floc run  @throws InputError if a column is missing, or no row belongs to such a test
Plot axial_test_plot(const CsvTable& path);

/// Rose diagrams of the directions of contacts, one colour a state: of all contacts, and of the strong ones.
Plot fabric_plot(const std::vector<std::pair<std::string, ContactDirections>>& states);

}  // namespace floc
