#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns a packing with its rattlers pushed against other grains. The positions of rattlers between the grains around
/// them are arbitrary; after the push, they no longer affect the numbers of neighbours at small gaps [AR2007]. Each
/// rattler is pushed in a fixed direction: the unit vector towards the nearest grain plus half the unit vector towards
/// the second-nearest grain. The rattler slides along the grains that it meets until Dim grains stop it. Only grains
/// that are not rattlers are obstacles, so the result depends neither on the numbering of the grains nor on the borders
/// of the periodic cell. A rattler is not moved if no grain stops it within two diameters of the largest grain. The
/// contact list is copied from the given packing, and is not valid for the rattlers that have moved.
///
/// @param rattler  whether each grain is a rattler (a grain that carries no force)
template <int Dim>
Packing<Dim> with_pushed_rattlers(const Packing<Dim>& packing, const std::vector<bool>& rattler);

}  // namespace floc
