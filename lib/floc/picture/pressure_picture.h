#pragma once

#include "floc/picture/packing_picture.h"

namespace floc {

/// Returns a picture in which the colour of each grain shows its pressure divided by the pressure of the packing. If
/// the pressure of the packing is not positive, the pressure of the grain is divided by F0/a (in 3D F0/a^2) instead,
/// with the pull-off force F0 and the largest diameter a. The colour scale ends at the 98 % quantile of the magnitudes
/// of these ratios.
/// @param pressure  pressure of the packing (stress)
template <int Dim>
PackingPicture<Dim> grain_pressures(const Packing<Dim>& packing, double pressure);

}  // namespace floc
