#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"

namespace floc {

/// Data about a packing of another program that the user gives beside its file.
struct ImportCompletion {
  std::string law_place;            ///< place where the law is given, for messages
  std::vector<double> stress;       ///< imposed, diagonal; empty: from the file, else from the contacts
  std::string stress_place;         ///< place where the stress is given, for messages
  std::optional<double> tolerance;  ///< tolerance of the equilibrium; none: chosen by the format
};

/// Completes the state of an imported packing with data that an analysis needs and the file lacks: contacts, imposed
/// stress, tolerances, residuals, and the version of floc.
/// @param place     file or array, for messages
/// @param imported  result of the reader
/// @param state     state held by `imported`
/// @return a remark for the user; empty if there is none
/// @throws InputError for a law of another dimension, grains that fill more than the cell, overlaps too large for the
/// law, or a stress with a wrong number of components
template <int Dim>
std::string complete_import(const std::string& place, const Imported& imported,
                            const ImportCompletion& completion, State<Dim>& state);

}  // namespace floc
