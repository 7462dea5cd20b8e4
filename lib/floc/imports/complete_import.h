#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"

namespace floc {

/// Data about a packing of another program that the user gives in addition to the file of the packing.
struct ImportCompletion {
  std::string law_place;            ///< place where the law is given, for messages
  std::vector<double> stress;       ///< imposed stress on each axis; empty: from the file, or from the contacts
  std::string stress_place;         ///< place where the stress is given, for messages
  std::optional<double> tolerance;  ///< tolerance of the equilibrium; if absent, the format decides
};

/// Completes the state of an imported packing with data that an analysis needs and the file lacks: contacts, imposed
/// stress, tolerances, residuals, and the version of floc.
/// @param place     file or array that contains the packing, for messages
/// @param imported  packing as it was read from its file
/// @param state     state to complete, a copy of the state in `imported`
/// @return a remark for the user; empty if there is none
/// @throws InputError for a law that does not apply to the dimension of the packing, a solid fraction above 1, overlaps
/// too large for the law, or a stress with a wrong number of components
template <int Dim>
std::string complete_import(const std::string& place, const Imported& imported,
                            const ImportCompletion& completion, State<Dim>& state);

}  // namespace floc
