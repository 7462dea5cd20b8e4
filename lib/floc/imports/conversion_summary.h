#pragma once

#include <string>
#include <vector>

#include "floc/io/import.h"

namespace floc {

/// Summary of a packing that was read from a file of another program, in lines of text.
struct ConversionSummary {
  std::vector<std::string> lines;            ///< data read and kept, and their comparison with the law
  std::vector<std::string> inconsistencies;  ///< disagreements of list, geometry, forces, law and equilibrium
};

/// Compares the contacts that a file lists with its geometry, and its forces with the law. Returns nothing for a
/// state of floc, which `floc verify` compares.
/// @param state  state held by `imported`, completed
template <int Dim>
ConversionSummary summarize(const Imported& imported, const State<Dim>& state);

}  // namespace floc
