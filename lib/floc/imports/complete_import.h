#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"

namespace floc {

/// Data that the user gives about a packing of another program, in addition to the file of the packing.
struct ImportCompletion {
  std::string law_place;  ///< option that gives the contact law, for messages
  /// Imposed stress on each axis. If empty, the imposed stress in the file is used. If the file has none, the stress
  /// computed from the contact forces is used.
  std::vector<double> stress;
  std::string stress_place;  ///< option that gives the stress, for messages
  /// Tolerance of the equilibrium. If absent, the default of floc is used or, if the file gives no imposed stress, a
  /// larger value.
  std::optional<double> tolerance;
  double touch_gap = 0.0;  ///< largest gap at which grains count as touching: see ImportOptions
};

/// Completes the state of a packing of another program. The function adds the data that an analysis needs but that are
/// missing in the file of the packing: contacts, imposed stress, tolerances, residuals, and the version of floc.
/// @param place  file or array that contains the packing, for messages
/// @param imported  packing as it was read from its file
/// @param state  state to complete, a copy of the state in `imported`
/// @return message that floc has computed the volumes of the liquid bridges, or that a given stress does not act on
/// fixed walls; empty if neither is the case
/// @throws InputError for a law that does not apply to the dimension of the packing, a solid fraction above 1, overlaps
/// too large for the law, or a stress with a wrong number of components
template <int Dim>
std::string complete_import(const std::string& place, const Imported& imported,
                            const ImportCompletion& completion, State<Dim>& state);

}  // namespace floc
