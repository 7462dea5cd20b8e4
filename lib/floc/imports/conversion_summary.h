#pragma once

#include <string>
#include <vector>

#include "floc/io/import.h"

namespace floc {

/// What there is to say of a packing that was read from a file of another program.
struct ConversionSummary {
  std::vector<std::string> lines;            ///< what was read and kept, and how it compares with the law
  std::vector<std::string> inconsistencies;  ///< where list, geometry, forces, law and equilibrium disagree
};

/// Compares what a file lists with its own geometry, and its forces with the law; nothing for a state of floc,
/// whose comparison is `floc verify`.
/// @param state  that of `imported`, complete
template <int Dim>
ConversionSummary summarize(const Imported& imported, const State<Dim>& state);

}  // namespace floc
