#pragma once

#include "floc/picture/packing_picture.h"

namespace floc {

/// Particle pressures as the colour of the grains, over the pressure of the packing, or over F0/a where that is
/// zero. The colours end at the value that 98 % of the grains stay within, either sign.
/// @param pressure  of the packing (stress)
PackingPicture grain_pressures(const Packing<2>& packing, double pressure);

}  // namespace floc
