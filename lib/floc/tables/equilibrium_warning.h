#pragma once

#include <string>

#include "floc/packing/state.h"
#include "floc/tables/remarks.h"

namespace floc {

/// Warns if a state is not in equilibrium. The warning lists those residuals (of forces, moments and stress) that
/// exceed their tolerances.
/// @param file  name of the state in the warning
template <int Dim>
void warn_unless_in_equilibrium(const std::string& file, const State<Dim>& state, const Remarks& remarks);

}  // namespace floc
