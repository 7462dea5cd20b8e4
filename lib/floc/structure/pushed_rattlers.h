#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns a packing with its rattlers pushed against other grains. The numbers of neighbours at small gaps are then
/// independent of the arbitrary positions of rattlers between the grains around them [AR2007]. Each rattler is pushed
/// in a fixed direction: the unit vector towards its nearest grain plus half the unit vector towards its second-nearest
/// grain. It slides along the grains that it meets until Dim grains stop it. Only grains that are not rattlers are
/// obstacles, so the result depends neither on the numbering of the grains nor on the borders of the periodic cell. A
/// rattler that meets no grain within a distance of two diameters of the largest grain is not moved. The list of
/// contacts is copied from the given packing; it is not valid for the rattlers that have moved.
///
/// @param rattler  whether each grain is a rattler (a grain that carries no force)
template <int Dim>
Packing<Dim> with_pushed_rattlers(const Packing<Dim>& packing, const std::vector<bool>& rattler);

}  // namespace floc
