#pragma once

#include <string>
#include <vector>

#include "floc/io/import.h"

namespace floc {

/// Summary of a packing that was read from a file of another program, in lines of text.
struct ConversionSummary {
  std::vector<std::string> lines;            ///< contacts read and kept, and their comparison with the law
  std::vector<std::string> inconsistencies;  ///< sentences about contradictions in the data of the packing
};

/// Compares the contacts that a file lists with the positions and radii of the grains, and the listed forces with the
/// contact law. Returns an empty summary for a state of floc, for which `floc verify` makes this comparison.
/// @param state  state in `imported` after complete_import()
template <int Dim>
ConversionSummary summarize(const Imported& imported, const State<Dim>& state);

}  // namespace floc
