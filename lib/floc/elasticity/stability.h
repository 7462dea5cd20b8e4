#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Number of negative eigenvalues of the stiffness matrix of a state, grains and diagonal strains, after rigid
/// translations, rattlers and free rollers are removed: 0 for a stable state. Mechanisms do not count. Without
/// prestress only distant attractions can make it more than 0.
template <int Dim>
int count_negative_eigenvalues(const Packing<Dim>& packing, bool prestress = false);

}  // namespace floc
