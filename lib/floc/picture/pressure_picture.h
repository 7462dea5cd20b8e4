#pragma once

#include "floc/picture/packing_picture.h"

namespace floc {

/// Returns a picture of particle pressures as the colour of the grains, over the pressure of the packing, or
/// over F0/a (in 3D F0/a^2) where that is zero. The colours end at the magnitude that 98 % of the grains do not
/// exceed.
/// @param pressure  pressure of the packing (stress)
template <int Dim>
PackingPicture<Dim> grain_pressures(const Packing<Dim>& packing, double pressure);

}  // namespace floc
