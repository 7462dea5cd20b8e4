#pragma once

#include <string>
#include <vector>

#include "floc/io/import.h"

namespace floc {

/// Summary (lines of text) of a packing that was read from a file of another program.
struct ConversionSummary {
  /// Lines about the numbers of contacts that were read and kept, and about differences between the contact forces and
  /// the forces of the law.
  std::vector<std::string> lines;
  std::vector<std::string> inconsistencies;  ///< sentences about contradictions in the data of the packing
};

/// Summarises an imported packing. Compares the contacts that the file lists with the positions and radii of the
/// grains, and the listed forces with the contact law. Returns an empty summary for a state file of floc, for which
/// `floc verify` makes this comparison.
/// @param state  state of `imported`, completed by complete_import()
template <int Dim>
ConversionSummary summarize(const Imported& imported, const State<Dim>& state);

}  // namespace floc
