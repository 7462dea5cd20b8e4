#pragma once

#include <string>

#include "floc/packing/state.h"
#include "floc/tables/remarks.h"

namespace floc {

/// Warns that a state is not an equilibrium, with its residuals that miss their tolerances; adds nothing for an
/// equilibrium.
/// @param file  name of the state in the warning
template <int Dim>
void warn_unless_in_equilibrium(const std::string& file, const State<Dim>& state, const Remarks& remarks);

}  // namespace floc
