#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"

namespace floc {

/// What the user says of another program's packing beside its file.
struct ImportCompletion {
  std::string law_place;       ///< where the law was said, for messages
  std::vector<double> stress;  ///< diagonal imposed; empty: what the file says, else what the contacts carry
  std::string stress_place;    ///< where that was said
  std::optional<double> tolerance;  ///< of the equilibrium; none: by what the file says
};

/// Fills in what the file did not say and an analysis needs: contacts, stress imposed, tolerances, residuals, the
/// program that did it.
/// @param place     file or array, for messages
/// @param imported  what was read
/// @param state     that of `imported`
/// @return what is to be said of it; empty: nothing
/// @throws InputError for a law of another dimension, grains that fill more than the cell, overlaps beyond what the
/// law is meant for, or a stress with another number of components
template <int Dim>
std::string complete_import(const std::string& place, const Imported& imported,
                            const ImportCompletion& completion, State<Dim>& state);

}  // namespace floc
